// SPDX-License-Identifier: BSD-3-Clause
// A topic for each of a robot's sensors that has a message of ROS (modules/messages/readings.hpp), with the name of its
// device; `scan` for a single laser. Frames are those of the devices, base_link for sensors without a mount.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "modules/messages/tf2_msgs.hpp"
#include "modules/nodes/node_side.hpp"
#include "modules/scenario/scenario.hpp"
#include "world/timed_sensor.hpp"

namespace waitpoint::nodes {

class SensorTopics {
 public:
  /// Advertises them; `global` makes the name of a topic, `prefix` begins the names of frames. Both must outlive this.
  SensorTopics(NodeSide& nodes, const scenario::RobotScenario& robot, Duration step, const std::string& prefix,
               const std::function<std::string(const std::string& topic)>& global);

  /// After a step of the world; `stamp` is the time for nodes.
  void publish(const world::World& world, world::BodyId id, messages::Stamp stamp);
  /// The transforms from `base` to its devices.
  void add_fixed(messages::tf2_msgs::TFMessage& tf, const std::string& base, messages::Stamp stamp) const;

 private:
  template <class S>
  struct Topic {
    world::TimedSensor<S> sensor;
    typename S::Description description;
    NodeSide::Topic topic;
    std::string frame;
  };
  template <class S>
  using Topics = std::vector<Topic<S>>;

  NodeSide& nodes_;
  world::Sensors::Tuple<Topics> topics_;
};

}  // namespace waitpoint::nodes
