// SPDX-License-Identifier: BSD-3-Clause
// A node that makes a map from laser scans and odometry, with four threads, and writes it as an image at its end. Its
// map depends on how its callbacks interleave: a scan is drawn from where the newest odometry had the robot when the
// scan's callback ran. An ordinary node for ROS 1, which knows nothing of waitpoint.
//
//   scan, odom  ->  map
//
// Private parameter: file ("map.pgm").
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <mutex>
#include <string>
#include <vector>

namespace {

constexpr int side = 1000;  // cells
constexpr std::size_t all_cells = std::size_t{side} * side;
constexpr double resolution_m = 0.1;
constexpr std::uint32_t threads = 4;

class Mapper {
 public:
  Mapper() : cells_(all_cells) {
    ros::NodeHandle("~").param("file", file_, std::string("map.pgm"));
    map_ = node_.advertise<nav_msgs::OccupancyGrid>("map", 1, true);
    scan_ = node_.subscribe("scan", 10, &Mapper::draw, this);
    odometry_ = node_.subscribe("odom", 10, &Mapper::move, this);
    timer_ = node_.createTimer(ros::Duration(5), &Mapper::show, this);
  }

  void write() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::ofstream image(file_, std::ios::binary);
    image << "P5\n" << side << ' ' << side << "\n255\n";
    for (int row = side - 1; row >= 0; --row)
      for (int column = 0; column < side; ++column)
        image.put(static_cast<char>(std::clamp(127 - cell(column, row), 0, 255)));
  }

 private:
  int& cell(int column, int row) {
    return cells_[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)];
  }

  void move(const nav_msgs::Odometry& odometry) {
    const std::lock_guard<std::mutex> lock(mutex_);
    x_ = odometry.pose.pose.position.x;
    y_ = odometry.pose.pose.position.y;
    heading_ = 2 * std::atan2(odometry.pose.pose.orientation.z, odometry.pose.pose.orientation.w);
  }

  void draw(const sensor_msgs::LaserScan& scan) {
    double x = 0, y = 0, heading = 0;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      x = x_, y = y_, heading = heading_;
    }
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      const double angle = heading + scan.angle_min + static_cast<double>(i) * scan.angle_increment;
      const bool has_echo = scan.ranges[i] < scan.range_max;
      const double range = has_echo ? scan.ranges[i] : scan.range_max;
      const std::lock_guard<std::mutex> lock(mutex_);
      for (double at = 0; at < range; at += resolution_m) add(x + at * std::cos(angle), y + at * std::sin(angle), -1);
      if (has_echo) add(x + range * std::cos(angle), y + range * std::sin(angle), 3);
    }
  }

  void add(double x, double y, int change) {
    const int column = static_cast<int>(std::floor(x / resolution_m)) + side / 2;
    const int row = static_cast<int>(std::floor(y / resolution_m)) + side / 2;
    if (column >= 0 && column < side && row >= 0 && row < side) cell(column, row) += change;
  }

  void show(const ros::TimerEvent&) {
    nav_msgs::OccupancyGrid map;
    map.header.frame_id = "odom";
    map.info.resolution = static_cast<float>(resolution_m);
    map.info.width = map.info.height = side;
    const std::lock_guard<std::mutex> lock(mutex_);
    map.data.reserve(cells_.size());
    for (const int cell : cells_) map.data.push_back(static_cast<std::int8_t>(cell == 0 ? -1 : cell > 0 ? 100 : 0));
    map_.publish(map);
  }

  std::mutex mutex_;  // of what follows
  std::vector<int> cells_;
  double x_ = 0, y_ = 0, heading_ = 0;

  std::string file_;
  ros::NodeHandle node_;
  ros::Publisher map_;
  ros::Subscriber scan_, odometry_;
  ros::Timer timer_;
};

}  // namespace

int main(int count, char** words) {
  ros::init(count, words, "mapper");
  Mapper mapper;
  ros::AsyncSpinner spinner(threads);
  spinner.start();
  ros::waitForShutdown();
  spinner.stop();
  mapper.write();
}
