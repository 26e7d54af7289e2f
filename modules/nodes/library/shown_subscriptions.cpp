// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/shown_subscriptions.hpp"

#include <geometry_msgs/PoseArray.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>

#include <utility>

#include "core/exact_math.hpp"

namespace waitpoint::nodes {
namespace {

constexpr std::uint32_t queue = 10;

Place place_of(const geometry_msgs::Pose& pose) {
  return {pose.position.x, pose.position.y, 2 * exact::atan2(pose.orientation.z, pose.orientation.w), pose.position.z};
}

void fill(ShownReading& reading, const nav_msgs::Path& path) {
  reading.places.reserve(path.poses.size());
  for (const geometry_msgs::PoseStamped& pose : path.poses) reading.places.push_back(place_of(pose.pose));
}

void fill(ShownReading& reading, const geometry_msgs::PoseArray& cloud) {
  reading.places.reserve(cloud.poses.size());
  for (const geometry_msgs::Pose& pose : cloud.poses) reading.places.push_back(place_of(pose));
}

void fill(ShownReading& reading, const nav_msgs::OccupancyGrid& grid) {
  reading.grid = {static_cast<int>(grid.info.width),
                  static_cast<int>(grid.info.height),
                  grid.info.resolution,
                  place_of(grid.info.origin),
                  {grid.data.begin(), grid.data.end()}};
}

}  // namespace

ShownSubscriptions::ShownSubscriptions(const RobotTopics& topics) : node_(topics.space) {
  for (const ShownTopic& shown : topics.shown) {
    switch (shown.kind) {
      case ShownTopic::Kind::path: subscribe<nav_msgs::Path>(shown); break;
      case ShownTopic::Kind::cloud: subscribe<geometry_msgs::PoseArray>(shown); break;
      case ShownTopic::Kind::grid: subscribe<nav_msgs::OccupancyGrid>(shown); break;
    }
  }
}

template <class Message>
void ShownSubscriptions::subscribe(const ShownTopic& shown) {
  const std::string name = node_.resolveName(shown.topic);
  subscribers_.push_back(node_.subscribe<Message>(
      shown.topic, queue, [this, kind = shown.kind, name](const typename Message::ConstPtr& message) {
        Received received{message->header.stamp, {}};
        received.reading.topic = name;
        received.reading.kind = kind;
        received.reading.frame = message->header.frame_id;
        fill(received.reading, *message);
        received_.push_back(std::move(received));
      }));
}

std::vector<ShownReading> ShownSubscriptions::take(const ros::Time& begin) {
  std::vector<ShownReading> taken;
  taken.reserve(received_.size());
  for (Received& received : std::exchange(received_, {})) {
    received.reading.date_ns = (received.stamp - begin).toNSec();
    taken.push_back(std::move(received.reading));
  }
  return taken;
}

}  // namespace waitpoint::nodes
