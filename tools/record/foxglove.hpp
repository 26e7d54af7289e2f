// SPDX-License-Identifier: BSD-3-Clause
// JSON messages of Foxglove's viewers (docs.foxglove.dev, "Foxglove schemas"), and their schemas. Lengths in metres,
// angles in radians, rotations as quaternions; times are virtual, from 0.
#pragma once

#include <span>
#include <string>

#include "modules/bridge/run_result.hpp"
#include "modules/posters/laser.hpp"
#include "tools/record/mcap_file.hpp"

namespace waitpoint::tools::foxglove {

Schema clock();
Schema frame_transform();
Schema laser_scan();
Schema log();
Schema pose_in_frame();
Schema poses_in_frame();
Schema scene_update();

/// The virtual time in ROS's format; Foxglove has no schema for it.
std::string clock(Time time);
/// The pose of `child` in `parent`.
std::string frame_transform(Time time, const std::string& parent, const std::string& child, const Pose& pose,
                            double z_m = 0);
/// A scan in its device's frame.
std::string laser_scan(const posters::LaserReading& scan, const std::string& frame);
/// A line of text with severity "information" or "warning".
std::string log(Time time, const std::string& who, const std::string& text, bool is_warning = false);
std::string pose_in_frame(Time time, const std::string& frame, const Pose& pose);
std::string poses_in_frame(Time time, const std::string& frame, std::span<const Pose> poses);
/// Static boxes and cylinders.
std::string scene_update(Time time, const std::string& frame, std::span<const world::Shape> shapes);

}  // namespace waitpoint::tools::foxglove
