// SPDX-License-Identifier: BSD-3-Clause
// A picture of a run: the floor, and for each robot its start, goals, paths (true, estimated, by odometry alone), its
// outline now and then and at the end, and the segments that its localisation built.
#pragma once

#include <span>
#include <string>

#include "modules/bridge/run_result.hpp"

namespace waitpoint::tools {

/// An SVG document. `obstacles` is all that stands on the floor, a map's boxes included: thousands are fine.
std::string picture_svg(std::span<const world::Obstacle> obstacles, const bridge::RunResult& result);

}  // namespace waitpoint::tools
