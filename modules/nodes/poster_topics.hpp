// SPDX-License-Identifier: BSD-3-Clause
// Posters of a robot's modules as topics, by the table `publish` of its key `ros`:
//
//   poster type              topic
//   FusedPosition            geometry_msgs/PoseWithCovarianceStamped, in `map`
//   Localisation             the same, unless it is lost
//   Odometry                 nav_msgs/Odometry, in the frame of the module's last SetPos
//   Echoes                   sensor_msgs/LaserScan
//   SpeedReference           geometry_msgs/Twist
//   Inertial                 sensor_msgs/Imu
//
// They are looked at after each step of the world, which is no event of the run.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "modules/genom/name_space.hpp"
#include "modules/nodes/node_side.hpp"
#include "modules/scenario/poster_topics.hpp"

namespace waitpoint::nodes {

class PosterTopics {
 public:
  /// Finds the posters; BadInput for one that is not there, or has a type that is no topic's.
  PosterTopics(const std::vector<scenario::PosterTopic>& table, const genom::NameSpace& names);

  /// The values written since the last call, in the order of the table.
  void read(std::vector<PosterReading>& readings);

 private:
  struct Row {
    std::function<std::optional<PosterReading>()> look;  // nothing if it is empty
    std::optional<std::int64_t> given_ns;                // date of the value that was read last
  };
  std::vector<Row> rows_;
};

}  // namespace waitpoint::nodes
