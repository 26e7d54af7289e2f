// SPDX-License-Identifier: BSD-3-Clause
// A picture of a run: the floor, and for each robot its start, goals, paths (true, estimated, odometry alone), outlines
// at intervals and at the end, and the segments mapped by its localisation.
#pragma once

#include <span>
#include <string>

#include "modules/bridge/run_result.hpp"
#include "modules/nodes/shown_topics.hpp"

namespace waitpoint::tools {

/// An SVG document. `obstacles` are all obstacles on the floor, including a map's boxes: thousands are fine.
/// `shown`: shown messages of ROS nodes.
std::string picture_svg(std::span<const world::Obstacle> obstacles, const bridge::RunResult& result,
                        std::span<const nodes::ShownMessage> shown = {});

}  // namespace waitpoint::tools
