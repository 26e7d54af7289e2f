// SPDX-License-Identifier: BSD-3-Clause
// A planted bug (missed-map.yaml): a driver that misses the latched map. It looks for itself in the map when that
// arrives; if its own place has not come by then, it drops the map, and no other one ever comes.
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <geometry_msgs/Twist.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <atomic>

namespace {

class Driver {
 public:
  Driver() {
    drive_ = node_.advertise<geometry_msgs::Twist>("cmd_vel", 1);
    start_ = node_.subscribe("initialpose", 1, &Driver::take_start, this);
    map_ = node_.subscribe("/map", 1, &Driver::take_map, this);
    goal_ = node_.subscribe("move_base_simple/goal", 1, &Driver::take_goal, this);
    odometry_ = node_.subscribe("base_pose_ground_truth", 1, &Driver::drive, this);
  }

 private:
  void take_start(const geometry_msgs::PoseWithCovarianceStamped&) { has_start_ = true; }

  void take_map(const nav_msgs::OccupancyGrid&) {
    if (!has_start_) return;  // the bug
    has_map_ = true;
  }

  void take_goal(const geometry_msgs::PoseStamped& goal) {
    goal_m_ = goal.pose.position.x;
    has_goal_ = true;
  }

  void drive(const nav_msgs::Odometry& here) {
    if (!has_map_ || !has_goal_) return;
    geometry_msgs::Twist twist;
    if (here.pose.pose.position.x < goal_m_ - 0.2) twist.linear.x = 0.5;
    drive_.publish(twist);
  }

  ros::NodeHandle node_;
  std::atomic<bool> has_start_{false}, has_map_{false}, has_goal_{false};
  std::atomic<double> goal_m_{0};
  ros::Publisher drive_;
  ros::Subscriber start_, map_, goal_, odometry_;
};

}  // namespace

int main(int count, char** words) {
  ros::init(count, words, "driver");
  const Driver driver;
  ros::MultiThreadedSpinner(2).spin();
}
