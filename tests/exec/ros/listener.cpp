// SPDX-License-Identifier: BSD-3-Clause
//
// Prints the numbers that it hears, up to 99.
#include <cstdio>

#include <ros/ros.h>
#include <std_msgs/String.h>

namespace {

void hear(const std_msgs::String::ConstPtr& number) {
  std::puts(number->data.c_str());
  if (number->data == "99") ros::shutdown();
}

}  // namespace

int main(int count, char** words) {
  ros::init(count, words, "listener");
  ros::NodeHandle node;
  const ros::Subscriber subscriber = node.subscribe("numbers", 10, hear);
  ros::spin();
}
