// SPDX-License-Identifier: BSD-3-Clause
//
// Publishes the numbers 0 to 99, ten a second, without waiting for a listener.
#include <ros/ros.h>
#include <std_msgs/String.h>

int main(int count, char** words) {
  ros::init(count, words, "talker");
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<std_msgs::String>("numbers", 10);
  ros::Rate rate(10);
  for (int i = 0; i < 100 && ros::ok(); ++i) {
    std_msgs::String number;
    number.data = std::to_string(i);
    publisher.publish(number);
    ros::spinOnce();
    rate.sleep();
  }
}
