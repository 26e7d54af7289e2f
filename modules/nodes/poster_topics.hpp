// SPDX-License-Identifier: BSD-3-Clause
// Posters of a robot's modules as topics, by the table `publish` of its key `ros`:
//
//   poster type              topic
//   FusedPosition            geometry_msgs/PoseWithCovarianceStamped, in `map`
//   Localisation             the same, unless it is lost
//   Odometry                 nav_msgs/Odometry, in the frame of the module's last SetPos
//   Echoes                   sensor_msgs/LaserScan
//   SpeedReference           geometry_msgs/Twist
//   readings of sensors      their message (modules/messages/readings.hpp), in `map` if they are in the world's frame
//
// They are looked at after each step of the world, which is no event of the run.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "modules/genom/name_space.hpp"
#include "modules/nodes/node_side.hpp"
#include "modules/scenario/poster_topics.hpp"

namespace waitpoint::nodes {

/// The header fields of the messages of a robot's posters.
struct PosterFrames {
  std::string prefix;      ///< of the robot's frames
  std::string laser;       ///< that of scans
  double scan_time_s = 0;  ///< between two scans
  Time begin;              ///< of the run, for nodes
};

class PosterTopics {
 public:
  /// Finds the posters; BadInput for one that is not there, or has a type that is no topic's.
  PosterTopics(const scenario::NodesScenario& nodes, const genom::NameSpace& names, PosterFrames frames);
  PosterTopics(const PosterTopics&) = delete;
  PosterTopics& operator=(const PosterTopics&) = delete;

  /// Publishes the values written since the last call, in the order of the table. A topic is advertised with its first
  /// value; `global` makes the name of it.
  void publish(NodeSide& nodes, const std::function<std::string(const std::string& topic)>& global);

 private:
  /// A poster's value as a message.
  struct Value {
    Time date;
    const messages::Ros1Type* type = nullptr;
    std::string bytes;
  };
  struct Row {
    std::string topic;
    std::function<std::optional<Value>(const std::optional<Time>& published)> look;  // nothing if it is not newer
    std::optional<Time> published = {};  // date of the value that was published last
    std::optional<NodeSide::Topic> advertised = {};
  };
  template <class T>
  std::function<std::optional<Value>(const std::optional<Time>&)> look_at(const genom::PosterBase& base) const;
  template <class... Types>
  bool find_look(const genom::PosterBase& base, Row& row) const;

  PosterFrames frames_;
  std::vector<Row> rows_;
};

}  // namespace waitpoint::nodes
