// SPDX-License-Identifier: BSD-3-Clause
// A planted bug (early-lookup.yaml): a node that takes from tf where the laser is mounted, at its start. It does so
// when it gets the robot's first pose, and assumes that the transform has come by then; if it has not, the lookup
// throws.
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

namespace {

class Localisation {
 public:
  Localisation() : listener_(transforms_) { start_ = node_.subscribe("initialpose", 1, &Localisation::begin, this); }

 private:
  void begin(const geometry_msgs::PoseWithCovarianceStamped&) {
    std::string base, frame;
    ros::param::param<std::string>("localisation/base", base, "base_link");
    ros::param::param<std::string>("localisation/frame", frame, "laser");
    const geometry_msgs::TransformStamped laser = transforms_.lookupTransform(base, frame, ros::Time(0));
    ROS_INFO("the laser is %.2f m ahead", laser.transform.translation.x);
  }

  ros::NodeHandle node_;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_;
  ros::Subscriber start_;
};

}  // namespace

int main(int count, char** words) {
  ros::init(count, words, "localisation");
  Localisation localisation;
  ros::spin();
}
