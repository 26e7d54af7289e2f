// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/sensor_topics.hpp"

#include <algorithm>

#include "modules/messages/readings.hpp"
#include "modules/messages/wire.hpp"

namespace waitpoint::nodes {
namespace {

using messages::messages_of;

template <class S>
concept HasMessage = requires(const typename S::Description& description, const typename S::Reading& reading) {
  messages_of(description, reading, std::string());
};
template <HasMessage S>
using MessageOf = typename decltype(messages_of(typename S::Description(), typename S::Reading(), ""))::value_type;

template <class S>
std::string topic_of(const scenario::RobotScenario& robot, std::size_t number) {
  if (std::is_same_v<S, world::Lasers> && robot.laser_names.size() == 1) return "scan";
  return robot.device_name<S>(number);
}

}  // namespace

SensorTopics::SensorTopics(NodeSide& nodes, const scenario::RobotScenario& robot, Duration step,
                           const std::string& prefix,
                           const std::function<std::string(const std::string& topic)>& global)
    : nodes_(nodes) {
  constexpr std::uint32_t queue = 10;
  world::Sensors::for_each([&]<class S>() {
    if constexpr (HasMessage<S>)
      for (std::size_t i = 0; i < robot.body.equipment.count<S>(); ++i) {
        const typename S::Description description = robot.body.equipment.description<S>(i);
        const auto messages_a_reading =
            static_cast<std::uint32_t>(std::max<std::size_t>(messages::mounts_of(description).size(), 1));
        constexpr bool is_latched = requires { S::built_in; };
        std::get<Topics<S>>(topics_).push_back(
            {world::TimedSensor<S>(i, description, step), description,
             nodes.advertise(global(topic_of<S>(robot, i)), messages::ros1_type<MessageOf<S>>(),
                             queue * messages_a_reading, is_latched),
             requires { S::in_world_frame;
      }
    ? "map" : prefix + (messages::mounts_of(description).empty() ? "base_link" : robot.device_name<S>(i))
  });
}
});
}

void SensorTopics::publish(const world::World& world, world::BodyId id, messages::Stamp stamp) {
  world::Sensors::for_each([&]<class S>() {
    if constexpr (HasMessage<S>)
      for (Topic<S>& each : std::get<Topics<S>>(topics_))
        each.sensor.read(world, id, world.steps(), [&] {
          for (MessageOf<S>& message : messages_of(each.description, each.sensor.reading(), each.frame)) {
            message.header.stamp = stamp;
            nodes_.publish(each.topic, messages::encode<messages::Wire::ros1>(message));
          }
        });
  });
}

void SensorTopics::add_fixed(messages::tf2_msgs::TFMessage& tf, const std::string& base, messages::Stamp stamp) const {
  world::Sensors::for_each([&]<class S>() {
    for (const Topic<S>& each : std::get<Topics<S>>(topics_))
      for (const messages::Mount& mount : messages::mounts_of(each.description)) {
        tf.transforms.push_back(
            messages::transform_message(Time(), base, each.frame + mount.suffix, mount.pose, mount.height_m));
        tf.transforms.back().header.stamp = stamp;
      }
  });
}

}  // namespace waitpoint::nodes
