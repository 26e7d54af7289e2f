// SPDX-License-Identifier: BSD-3-Clause
// What a run shows, as messages of Foxglove's viewers.
#pragma once

#include <string>
#include <vector>

#include "modules/bridge/run_result.hpp"
#include "modules/messages/foxglove.hpp"
#include "modules/nodes/shown_topics.hpp"
#include "modules/posters/laser.hpp"

namespace waitpoint::tools {

namespace foxglove = messages::foxglove;

/// In its device's frame.
foxglove::LaserScan scan_of(const posters::LaserReading& reading, const std::string& frame);
/// A line of text.
foxglove::Log line_of(Time date, const std::string& writer, const std::string& text, bool is_warning);
/// Static boxes and cylinders.
foxglove::SceneUpdate scene_of(Time date, const std::string& frame, const std::vector<world::Shape>& shapes);
/// Of a path or a cloud.
foxglove::PosesInFrame poses_of(const nodes::ShownMessage& message, const std::string& frame);

}  // namespace waitpoint::tools
