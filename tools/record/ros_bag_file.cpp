// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/ros_bag_file.hpp"

#include <console_bridge/console.h>
#include <geometry_msgs/PoseArray.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <rosbag/bag.h>
#include <rosgraph_msgs/Clock.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_msgs/TFMessage.h>
#include <visualization_msgs/MarkerArray.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace waitpoint::tools {
namespace {

ros::Time time_of(std::int64_t ns) {
  constexpr std::int64_t second = 1'000'000'000;
  return {static_cast<std::uint32_t>(ns / second), static_cast<std::uint32_t>(ns % second)};
}

std_msgs::Header header_of(const RosBagFile::Place& place) {
  std_msgs::Header header;
  header.stamp = time_of(place.time_ns);
  header.frame_id = place.frame;
  return header;
}

geometry_msgs::Quaternion turn_of(const RosBagFile::Place& place) {
  geometry_msgs::Quaternion turn;
  turn.z = place.sin_half;
  turn.w = place.cos_half;
  return turn;
}

geometry_msgs::Pose pose_of(const RosBagFile::Place& place) {
  geometry_msgs::Pose pose;
  pose.position.x = place.x;
  pose.position.y = place.y;
  pose.position.z = place.z;
  pose.orientation = turn_of(place);
  return pose;
}

// In ROS's order: x, y, z and the angles about them.
boost::array<double, 36> of(const RosBagFile::Covariance& covariance) {
  constexpr std::size_t places[] = {0, 1, 5};
  boost::array<double, 36> all{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      all[6 * places[row] + places[column]] = covariance[3 * row + column];
  return all;
}

// A bag that could not be written or closed is leaked: its destructor would write again, to a file that may be closed
// already, and throw. At the end of the process, ROS's loader of plugins would warn of an object that the bag holds.
struct Bag {
  rosbag::Bag* bag = new rosbag::Bag;

  Bag() = default;
  Bag(const Bag&) = delete;
  Bag& operator=(const Bag&) = delete;
  ~Bag() {
    try {
      if (bag != nullptr) call([](rosbag::Bag& open) { open.close(); });
    } catch (const std::runtime_error&) {
    }
    delete bag;
  }

  /// The library's exceptions do not name the system's error.
  template <class Call>
  void call(Call make_call) {
    rosbag::Bag* const called = std::exchange(bag, nullptr);
    if (called == nullptr) throw std::runtime_error("an earlier error");
    errno = 0;
    try {
      make_call(*called);
    } catch (const std::exception& failure) {
      const int reason = errno;
      console_bridge::setLogLevel(console_bridge::CONSOLE_BRIDGE_LOG_NONE);
      throw std::runtime_error(reason != 0 ? std::strerror(reason) : failure.what());
    }
    bag = called;
  }
};

class WrittenBag final : public RosBagFile {
 public:
  explicit WrittenBag(const std::string& path) : path_(path) {
    bag_.call([&](rosbag::Bag& bag) { bag.open(path, rosbag::bagmode::Write); });
  }

  void set_time(std::int64_t now_ns) override { now_ns_ = now_ns; }
  void write_clock() override;
  void write_transform(const Place& child, const std::string& child_frame) override;
  void write_pose(const std::string& topic, const Place& place) override;
  void write_pose(const std::string& topic, const Place& place, const Covariance& covariance) override;
  void write_odometry(const std::string& topic, const Place& place, const Covariance& covariance,
                      const std::string& child, double v, double w) override;
  void write_scan(const std::string& topic, const Scan& scan) override;
  void write_solids(const std::string& topic, const std::vector<Solid>& solids) override;
  void write_path(const std::string& topic, std::int64_t time_ns, const std::string& frame,
                  const std::vector<Place>& places) override;
  void write_poses(const std::string& topic, std::int64_t time_ns, const std::string& frame,
                   const std::vector<Place>& places) override;
  void write_grid(const std::string& topic, const Grid& grid) override;
  void write_log(const std::string& topic, std::int64_t time_ns, const std::string& who, const std::string& text,
                 bool is_warning) override;
  void close() override;

 private:
  template <class Message>
  void write(const std::string& topic, const Message& message);

  std::string path_;
  Bag bag_;
  std::int64_t now_ns_ = 0;
};

template <class Message>
void WrittenBag::write(const std::string& topic, const Message& message) {
  bag_.call([&](rosbag::Bag& bag) { bag.write(topic, std::max(time_of(now_ns_), ros::TIME_MIN), message); });
}

void WrittenBag::write_clock() {
  rosgraph_msgs::Clock clock;
  clock.clock = time_of(now_ns_);
  write("/clock", clock);
}

void WrittenBag::write_transform(const Place& child, const std::string& child_frame) {
  geometry_msgs::TransformStamped transform;
  transform.header = header_of(child);
  transform.child_frame_id = child_frame;
  transform.transform.translation.x = child.x;
  transform.transform.translation.y = child.y;
  transform.transform.translation.z = child.z;
  transform.transform.rotation = turn_of(child);
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  write("/tf", message);
}

void WrittenBag::write_pose(const std::string& topic, const Place& place) {
  geometry_msgs::PoseStamped message;
  message.header = header_of(place);
  message.pose = pose_of(place);
  write(topic, message);
}

void WrittenBag::write_pose(const std::string& topic, const Place& place, const Covariance& covariance) {
  geometry_msgs::PoseWithCovarianceStamped message;
  message.header = header_of(place);
  message.pose.pose = pose_of(place);
  message.pose.covariance = of(covariance);
  write(topic, message);
}

void WrittenBag::write_odometry(const std::string& topic, const Place& place, const Covariance& covariance,
                                const std::string& child, double v, double w) {
  nav_msgs::Odometry message;
  message.header = header_of(place);
  message.child_frame_id = child;
  message.pose.pose = pose_of(place);
  message.pose.covariance = of(covariance);
  message.twist.twist.linear.x = v;
  message.twist.twist.angular.z = w;
  write(topic, message);
}

void WrittenBag::write_scan(const std::string& topic, const Scan& scan) {
  sensor_msgs::LaserScan message;
  message.header.stamp = time_of(scan.time_ns);
  message.header.frame_id = scan.frame;
  const auto steps = static_cast<double>(std::max<std::size_t>(scan.ranges.size(), 1) - 1);
  message.angle_min = static_cast<float>(scan.first_angle);
  message.angle_max = static_cast<float>(scan.first_angle + steps * scan.angle_step);
  message.angle_increment = static_cast<float>(scan.angle_step);
  message.range_max = static_cast<float>(scan.range_max);
  message.ranges = scan.ranges;
  write(topic, message);
}

void WrittenBag::write_solids(const std::string& topic, const std::vector<Solid>& solids) {
  visualization_msgs::MarkerArray all;
  for (const Solid& solid : solids) {
    visualization_msgs::Marker marker;
    marker.header = header_of(solid.place);
    marker.ns = topic;
    marker.id = static_cast<std::int32_t>(all.markers.size());
    marker.type = solid.is_box ? visualization_msgs::Marker::CUBE : visualization_msgs::Marker::CYLINDER;
    marker.pose = pose_of(solid.place);
    marker.scale.x = solid.size[0];
    marker.scale.y = solid.size[1];
    marker.scale.z = solid.size[2];
    marker.color.r = marker.color.g = marker.color.b = 0.6f;
    marker.color.a = 1;
    all.markers.push_back(marker);
  }
  write(topic, all);
}

void WrittenBag::write_path(const std::string& topic, std::int64_t time_ns, const std::string& frame,
                            const std::vector<Place>& places) {
  nav_msgs::Path path;
  path.header = header_of({time_ns, frame, 0, 0, 0, 0, 1});
  for (const Place& place : places) {
    geometry_msgs::PoseStamped pose;
    pose.header = header_of(place);
    pose.pose = pose_of(place);
    path.poses.push_back(pose);
  }
  write(topic, path);
}

void WrittenBag::write_poses(const std::string& topic, std::int64_t time_ns, const std::string& frame,
                             const std::vector<Place>& places) {
  geometry_msgs::PoseArray poses;
  poses.header = header_of({time_ns, frame, 0, 0, 0, 0, 1});
  for (const Place& place : places) poses.poses.push_back(pose_of(place));
  write(topic, poses);
}

void WrittenBag::write_grid(const std::string& topic, const Grid& grid) {
  nav_msgs::OccupancyGrid message;
  message.header = header_of(grid.origin);
  message.info.map_load_time = message.header.stamp;
  message.info.width = static_cast<std::uint32_t>(grid.width);
  message.info.height = static_cast<std::uint32_t>(grid.height);
  message.info.resolution = static_cast<float>(grid.resolution);
  message.info.origin = pose_of(grid.origin);
  message.data.assign(grid.cells.begin(), grid.cells.end());
  write(topic, message);
}

void WrittenBag::write_log(const std::string& topic, std::int64_t time_ns, const std::string& who,
                           const std::string& text, bool is_warning) {
  rosgraph_msgs::Log log;
  log.header.stamp = time_of(time_ns);
  log.level = is_warning ? rosgraph_msgs::Log::WARN : rosgraph_msgs::Log::INFO;
  log.name = who;
  log.msg = text;
  write(topic, log);
}

void WrittenBag::close() {
  bag_.call([](rosbag::Bag& bag) { bag.close(); });
  // The library overlooks failures of ftello(), after which its index points elsewhere.
  try {
    Bag written;
    written.call([&](rosbag::Bag& bag) { bag.open(path_, rosbag::bagmode::Read); });
    written.call([](rosbag::Bag& bag) { bag.close(); });
  } catch (const std::runtime_error&) {
    throw std::runtime_error("its index cannot be read back");
  }
}

std::unique_ptr<RosBagFile> make(const std::string& path) { return std::make_unique<WrittenBag>(path); }

}  // namespace
}  // namespace waitpoint::tools

extern "C" [[gnu::visibility("default")]] const waitpoint::tools::BagLibrary waitpoint_bag_library_1 = {
    .make = &waitpoint::tools::make};
