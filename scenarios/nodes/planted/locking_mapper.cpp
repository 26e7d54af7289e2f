// SPDX-License-Identifier: BSD-3-Clause
// Half of a planted deadlock (lock-in-call.yaml): the mapper asks the localiser where it is while it holds the
// lock of its map, and the localiser asks the mapper for the map while it holds the lock of its pose.
//
//   map_changed (topic), map_at (service)  <->  where (service)
#include <ros/ros.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/Trigger.h>

#include <mutex>

namespace {

class Mapper {
 public:
  Mapper() {
    changed_ = node_.advertise<std_msgs::UInt32>("map_changed", 1);
    map_at_ = node_.advertiseService("map_at", &Mapper::answer, this);
    ros::service::waitForService("where");
    where_ = node_.serviceClient<std_srvs::Trigger>("where", true);
    timer_ = node_.createTimer(ros::Duration(0.5), &Mapper::update, this);
  }

 private:
  // The bug: the call, which needs the other node, is made within the lock.
  void update(const ros::TimerEvent&) {
    const std::lock_guard<std::mutex> lock(map_mutex_);
    std_msgs::UInt32 number;
    number.data = ++updates_;
    changed_.publish(number);
    std_srvs::Trigger pose;
    where_.call(pose);
  }

  bool answer(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    const std::lock_guard<std::mutex> lock(map_mutex_);
    response.success = updates_ > 0;
    return true;
  }

  ros::NodeHandle node_;
  std::mutex map_mutex_;
  unsigned updates_ = 0;
  ros::Publisher changed_;
  ros::ServiceServer map_at_;
  ros::ServiceClient where_;
  ros::Timer timer_;
};

}  // namespace

int main(int count, char** words) {
  ros::init(count, words, "mapper");
  Mapper mapper;
  ros::MultiThreadedSpinner(2).spin();
}
