// SPDX-License-Identifier: BSD-3-Clause
// The other half of a planted deadlock: see locking_mapper.cpp.
#include <ros/ros.h>
#include <std_msgs/UInt32.h>
#include <std_srvs/Trigger.h>

#include <mutex>

namespace {

class Localiser {
 public:
  Localiser() {
    where_ = node_.advertiseService("where", &Localiser::answer, this);
    ros::service::waitForService("map_at");
    map_at_ = node_.serviceClient<std_srvs::Trigger>("map_at", true);
    changed_ = node_.subscribe("map_changed", 1, &Localiser::match, this);
  }

 private:
  // The bug: the call, which needs the other node, is made within the lock.
  void match(const std_msgs::UInt32&) {
    double value = 0;
    for (const char* const name : {"localiser/step_m", "localiser/noise_m"}) ros::param::get(name, value);
    const std::lock_guard<std::mutex> lock(pose_mutex_);
    std_srvs::Trigger map;
    map_at_.call(map);
  }

  bool answer(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
    const std::lock_guard<std::mutex> lock(pose_mutex_);
    response.success = true;
    return true;
  }

  ros::NodeHandle node_;
  std::mutex pose_mutex_;
  ros::ServiceServer where_;
  ros::ServiceClient map_at_;
  ros::Subscriber changed_;
};

}  // namespace

int main(int count, char** words) {
  ros::init(count, words, "localiser");
  Localiser localiser;
  ros::MultiThreadedSpinner(2).spin();
}
