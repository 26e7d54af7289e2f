// SPDX-License-Identifier: BSD-3-Clause
// Two nodelets, which pass messages within their manager's process:
//
//   waitpoint_nodes/Thin     scan -> thin_scan: every tenth beam
//   waitpoint_nodes/Nearest  thin_scan -> nearest (std_msgs/Float32): the least range, m
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Float32.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>

namespace waitpoint_nodes {

class Thin : public nodelet::Nodelet {
  void onInit() override {
    thin_ = getNodeHandle().advertise<sensor_msgs::LaserScan>("thin_scan", 10);
    scan_ = getNodeHandle().subscribe("scan", 10, &Thin::take, this);
  }

  void take(const sensor_msgs::LaserScan::ConstPtr& scan) {
    constexpr std::size_t each = 10;
    const auto thin = boost::make_shared<sensor_msgs::LaserScan>(*scan);
    thin->angle_increment *= each;
    thin->ranges.clear();
    for (std::size_t i = 0; i < scan->ranges.size(); i += each) thin->ranges.push_back(scan->ranges[i]);
    thin_.publish(thin);
  }

  ros::Publisher thin_;
  ros::Subscriber scan_;
};

class Nearest : public nodelet::Nodelet {
  void onInit() override {
    nearest_ = getNodeHandle().advertise<std_msgs::Float32>("nearest", 10);
    scan_ = getNodeHandle().subscribe("thin_scan", 10, &Nearest::take, this);
  }

  void take(const sensor_msgs::LaserScan::ConstPtr& scan) {
    std_msgs::Float32 nearest;
    nearest.data = scan->range_max;
    for (const float range : scan->ranges) nearest.data = std::min(nearest.data, range);
    nearest_.publish(nearest);
  }

  ros::Publisher nearest_;
  ros::Subscriber scan_;
};

}  // namespace waitpoint_nodes

PLUGINLIB_EXPORT_CLASS(waitpoint_nodes::Thin, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(waitpoint_nodes::Nearest, nodelet::Nodelet)
