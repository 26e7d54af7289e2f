// SPDX-License-Identifier: BSD-3-Clause
// Topics of ROS nodes that pictures and recordings show, by the table `show` of a robot's `ros`: paths
// (nav_msgs/Path), clouds of poses (geometry_msgs/PoseArray), grids (nav_msgs/OccupancyGrid).
//
// The world's node subscribes to them in every run, drawn or not: a viewer never changes a run.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/occupancy_grid.hpp"
#include "core/pose.hpp"
#include "core/time.hpp"
#include "modules/messages/description.hpp"

namespace waitpoint::nodes {

/// A message as it came. Places are in its frame, which a picture takes for the map.
struct ShownMessage {
  enum class Kind : unsigned char { path, cloud, grid };

  std::string topic;  ///< global
  Kind kind = Kind::path;
  Time date;  ///< of its stamp
  std::string frame;
  std::vector<Pose> poses;            ///< of paths and clouds
  std::optional<OccupancyGrid> grid;  ///< of grids
};

/// The type of a kind's messages.
const messages::Ros1Type& shown_type(ShownMessage::Kind kind);

/// A message in ROS 1's wire format. Poses that are no numbers are left out, and a grid whose size is not that of its
/// cells. BadInput for one that is cut off.
ShownMessage shown_message(ShownMessage::Kind kind, const std::string& topic, std::string_view bytes, Time begin);

/// The messages of a run.
class ShownTopics {
 public:
  void add(ShownMessage message);
  /// From now on take() has messages, and has to be called.
  void begin_recording() { is_recorded_ = true; }

  /// Those since the last call, in the order in which they came.
  std::vector<ShownMessage> take() { return std::exchange(new_, {}); }
  /// The last cloud and grid of each topic, and its paths, at most one in five seconds.
  const std::vector<ShownMessage>& to_draw() const { return to_draw_; }

 private:
  std::vector<ShownMessage> new_, to_draw_;
  bool is_recorded_ = false;
};

}  // namespace waitpoint::nodes
