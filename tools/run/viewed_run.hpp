// SPDX-License-Identifier: BSD-3-Clause
// A run that browsers can look at: two processes, the run and its viewer.
#pragma once

#include <functional>

#include "tools/run/run_options.hpp"
#include "tools/view/history/channel.hpp"
#include "tools/view/scene.hpp"

namespace waitpoint::tools {

/// The head of this run's page.
view::SceneOptions scene_options(const RunOptions& options, const scenario::Scenario& scenario);

/// The past of a run is seen in copies of its process: BadInput, naming --serve, for robots with programs, which have
/// files and processes of their own.
void check_can_be_viewed(const scenario::Scenario& scenario);

/// Divides this process. The new one calls `run` with its connection to the viewer, and this returns its status there.
/// The old one, which the terminal knows, is the viewer: it serves the page until Ctrl-C, also when the run is over,
/// and returns the status of the run. BadInput, before the run begins, if it cannot listen.
int run_viewed(const RunOptions& options, const scenario::Scenario& scenario,
               const std::function<int(view::Channel& viewer)>& run);

}  // namespace waitpoint::tools
