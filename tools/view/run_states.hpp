// SPDX-License-Identifier: BSD-3-Clause
// The state of a run's software at an instant, as JSON: its tasks with their waits, and a robot's modules,
// with their activities, periods and posters. Reading is not an event.
#pragma once

#include "modules/run/experiment.hpp"
#include "tools/view/view_json.hpp"

namespace waitpoint::tools::view {

/// {"kind":"tasks","time":...,"tasks":[...]}.
Json task_states(run::Experiment& experiment);

/// {"kind":"modules","time":...,"robot":...,"modules":[...],"posters":[...]}.
Json module_states(run::Experiment& experiment, std::size_t robot);

}  // namespace waitpoint::tools::view
