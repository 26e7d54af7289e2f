// SPDX-License-Identifier: BSD-3-Clause
// A node that drives a robot to the goals of move_base_simple/goal: it plans on the map, follows the way, and slows
// down and stops before what its laser sees. An ordinary node for ROS 1, which knows nothing of waitpoint.
//
//   map, move_base_simple/goal, scan, tf  ->  cmd_vel, plan
//
// Private parameters: speed_m_s (0.6), radius_m (0.3).
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <sensor_msgs/LaserScan.h>
#include <tf2_ros/transform_listener.h>

#include <memory>

#include "scenarios/nodes/route.hpp"

namespace {

constexpr double turn_most = 1.2, ahead_m = 0.5, arrived_m = 0.15, shown_m = 60;

double heading_of(const geometry_msgs::Quaternion& turn) { return 2 * std::atan2(turn.z, turn.w); }

class Driver {
 public:
  Driver() : listener_(transforms_) {
    ros::NodeHandle own("~");
    own.param("speed_m_s", speed_, 0.6);
    own.param("radius_m", radius_, 0.3);
    map_ = node_.subscribe("/map", 1, &Driver::take_map, this);
    goal_ = node_.subscribe("move_base_simple/goal", 1, &Driver::take_goal, this);
    scan_ = node_.subscribe("scan", 1, &Driver::take_scan, this);
    drive_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    plan_ = node_.advertise<nav_msgs::Path>("plan", 1, true);
    timer_ = node_.createTimer(ros::Duration(0.1), &Driver::go_on, this);
  }

 private:
  void take_map(const nav_msgs::OccupancyGrid& map) {
    constexpr double wanted_m = 0.4;
    route_ = std::make_unique<Route>(map, radius_, radius_ + wanted_m);
    if (has_goal_) route_->set_goal(target_);
  }

  void take_goal(const geometry_msgs::PoseStamped& goal) {
    target_ = {goal.pose.position.x, goal.pose.position.y};
    has_goal_ = true;
    is_shown_ = false;
    if (route_) route_->set_goal(target_);
  }

  // The free distance in the robot's way, from its front.
  void take_scan(const sensor_msgs::LaserScan& scan) {
    free_m_ = scan.range_max;
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      const double angle = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
      const double x = scan.ranges[i] * std::cos(angle), y = scan.ranges[i] * std::sin(angle);
      if (x > 0 && std::fabs(y) < radius_ + 0.05) free_m_ = std::min(free_m_, x - radius_);
    }
  }

  void go_on(const ros::TimerEvent&) {
    geometry_msgs::TransformStamped here;
    try {
      here = transforms_.lookupTransform("map", "base_link", ros::Time(0));
    } catch (const tf2::TransformException&) {
      return;  // nobody has told it yet
    }
    if (!route_ || !has_goal_) return;
    const Place place{here.transform.translation.x, here.transform.translation.y};
    if (!is_shown_) show(place, here.header.stamp);
    drive_.publish(speeds(place, heading_of(here.transform.rotation)));
  }

  geometry_msgs::Twist speeds(const Place& here, double heading) {
    geometry_msgs::Twist twist;
    const double left = std::hypot(target_.x - here.x, target_.y - here.y);
    const std::vector<Place> way = route_->from(here, ahead_m);
    if (left < arrived_m || way.empty()) {
      has_goal_ = left >= arrived_m;
      return twist;
    }
    const Place next = way.back();
    const double off = std::remainder(std::atan2(next.y - here.y, next.x - here.x) - heading, 2 * M_PI);
    twist.angular.z = std::max(-turn_most, std::min(turn_most, 2 * off));
    const double straight = std::max(0.0, 1 - 1.5 * std::fabs(off));
    twist.linear.x = std::min({speed_ * straight, std::max(0.0, free_m_ - 0.1), 0.1 + left});
    return twist;
  }

  void show(const Place& here, const ros::Time& stamp) {
    nav_msgs::Path path;
    path.header.frame_id = "map";
    path.header.stamp = stamp;
    for (const Place& place : route_->from(here, shown_m)) {
      geometry_msgs::PoseStamped pose;
      pose.header = path.header;
      pose.pose.position.x = place.x;
      pose.pose.position.y = place.y;
      pose.pose.orientation.w = 1;
      path.poses.push_back(pose);
    }
    plan_.publish(path);
    is_shown_ = true;
  }

  ros::NodeHandle node_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  ros::Subscriber map_, goal_, scan_;
  ros::Publisher drive_, plan_;
  ros::Timer timer_;
  std::unique_ptr<Route> route_;
  Place target_;
  bool has_goal_ = false, is_shown_ = false;
  double speed_ = 0, radius_ = 0, free_m_ = 0;
};

}  // namespace

int main(int count, char** words) {
  ros::init(count, words, "driver");
  const Driver driver;
  ros::spin();
}
