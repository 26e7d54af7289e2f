// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/shown_topics.hpp"

#include <algorithm>
#include <cmath>

#include "modules/messages/nav_msgs.hpp"
#include "modules/messages/poses.hpp"
#include "modules/messages/wire.hpp"

namespace waitpoint::nodes {
namespace {

/// Between two paths of a topic that are drawn: those of a local planner come many times a second.
constexpr Duration between_paths = std::chrono::seconds(5);

std::optional<OccupancyGrid> grid_of(const messages::nav_msgs::OccupancyGrid& message) {
  const auto cells = static_cast<std::int64_t>(message.info.width) * message.info.height;
  if (cells < 1 || cells > OccupancyGrid::cells_max || !(message.info.resolution > 0) ||
      cells != static_cast<std::int64_t>(message.data.size()))
    return std::nullopt;
  constexpr int occupied = 65, free = 25;  // per cent, as map_server has them
  const int width = static_cast<int>(message.info.width), height = static_cast<int>(message.info.height);
  OccupancyGrid grid(width, height, message.info.resolution, messages::pose_of(message.info.origin));
  auto value = message.data.begin();
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x, ++value)
      grid[{x, y}] = *value < 0           ? Cell::unknown
                     : *value >= occupied ? Cell::occupied
                     : *value <= free     ? Cell::free
                                          : Cell::unknown;
  return grid;
}

void add_pose(const messages::geometry_msgs::Pose& message, ShownMessage& shown) {
  const Pose pose = messages::pose_of(message);
  if (std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.heading)) shown.poses.push_back(pose);
}
void fill(const messages::nav_msgs::Path& path, ShownMessage& shown) {
  for (const auto& pose : path.poses) add_pose(pose.pose, shown);
}
void fill(const messages::geometry_msgs::PoseArray& cloud, ShownMessage& shown) {
  for (const auto& pose : cloud.poses) add_pose(pose, shown);
}
void fill(const messages::nav_msgs::OccupancyGrid& grid, ShownMessage& shown) { shown.grid = grid_of(grid); }

template <class M>
ShownMessage read(ShownMessage::Kind kind, const std::string& topic, std::string_view bytes, Time begin) {
  const M message = messages::decode<M, messages::Wire::ros1>("a message of " + topic, bytes);
  const Duration date = messages::time_of(message.header.stamp) - begin;
  ShownMessage shown{.topic = topic,
                     .kind = kind,
                     .date = Time() + std::max(date, Duration()),
                     .frame = message.header.frame_id,
                     .poses = {},
                     .grid = {}};
  fill(message, shown);
  return shown;
}

}  // namespace

const messages::Ros1Type& shown_type(ShownMessage::Kind kind) {
  switch (kind) {
    case ShownMessage::Kind::path: return messages::ros1_type<messages::nav_msgs::Path>();
    case ShownMessage::Kind::cloud: return messages::ros1_type<messages::geometry_msgs::PoseArray>();
    case ShownMessage::Kind::grid: break;
  }
  return messages::ros1_type<messages::nav_msgs::OccupancyGrid>();
}

ShownMessage shown_message(ShownMessage::Kind kind, const std::string& topic, std::string_view bytes, Time begin) {
  switch (kind) {
    case ShownMessage::Kind::path: return read<messages::nav_msgs::Path>(kind, topic, bytes, begin);
    case ShownMessage::Kind::cloud: return read<messages::geometry_msgs::PoseArray>(kind, topic, bytes, begin);
    case ShownMessage::Kind::grid: break;
  }
  return read<messages::nav_msgs::OccupancyGrid>(kind, topic, bytes, begin);
}

void ShownTopics::add(ShownMessage message) {
  if (is_recorded_) new_.push_back(message);
  const auto last = std::find_if(to_draw_.rbegin(), to_draw_.rend(),
                                 [&](const ShownMessage& other) { return other.topic == message.topic; });
  if (last == to_draw_.rend() ||
      (message.kind == ShownMessage::Kind::path && message.date - last->date >= between_paths))
    to_draw_.push_back(std::move(message));
  else if (message.kind != ShownMessage::Kind::path)
    *last = std::move(message);
}

}  // namespace waitpoint::nodes
