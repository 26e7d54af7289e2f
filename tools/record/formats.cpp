// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/formats.hpp"

#include "core/error.hpp"
#include "tools/record/carmen_recording.hpp"
#include "tools/record/foxglove_recording.hpp"
#include "tools/record/ros_bag_recording.hpp"

namespace waitpoint::tools {

std::unique_ptr<Recording> make_recording(const std::filesystem::path& path, const scenario::Scenario& scenario) {
  if (path.extension() == ".mcap") return std::make_unique<FoxgloveRecording>(path, scenario);
  if (path.extension() == ".log") return std::make_unique<CarmenRecording>(path, scenario);
  if (path.extension() == ".bag") return std::make_unique<RosBagRecording>(path, scenario);
  throw BadInput("--record",
                 "expected a file .mcap (Foxglove), .bag (ROS 1) or .log (CARMEN), found '" + path.string() + "'");
}

}  // namespace waitpoint::tools
