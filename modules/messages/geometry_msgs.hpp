// SPDX-License-Identifier: BSD-3-Clause
// Messages of ROS's package geometry_msgs. Metres, radians, seconds.
#pragma once

#include "modules/messages/message.hpp"
#include "modules/messages/std_msgs.hpp"

namespace waitpoint::messages::geometry_msgs {

struct Vector3 {
  static constexpr std::string_view type_name = "geometry_msgs/Vector3";
  double x = 0;
  double y = 0;
  double z = 0;
  static void fields(auto field) {
    field("x", &Vector3::x);
    field("y", &Vector3::y);
    field("z", &Vector3::z);
  }
};

struct Point {
  static constexpr std::string_view type_name = "geometry_msgs/Point";
  double x = 0;
  double y = 0;
  double z = 0;
  static void fields(auto field) {
    field("x", &Point::x);
    field("y", &Point::y);
    field("z", &Point::z);
  }
};

struct PointStamped {
  static constexpr std::string_view type_name = "geometry_msgs/PointStamped";
  std_msgs::Header header;
  Point point;
  static void fields(auto field) {
    field("header", &PointStamped::header);
    field("point", &PointStamped::point);
  }
};

struct Quaternion {
  static constexpr std::string_view type_name = "geometry_msgs/Quaternion";
  double x = 0;
  double y = 0;
  double z = 0;
  double w = 0;
  static void fields(auto field) {
    field("x", &Quaternion::x);
    field("y", &Quaternion::y);
    field("z", &Quaternion::z);
    field("w", &Quaternion::w);
  }
};

struct Pose {
  static constexpr std::string_view type_name = "geometry_msgs/Pose";
  Point position;
  Quaternion orientation;
  static void fields(auto field) {
    field("position", &Pose::position);
    field("orientation", &Pose::orientation);
  }
};

struct PoseStamped {
  static constexpr std::string_view type_name = "geometry_msgs/PoseStamped";
  std_msgs::Header header;
  Pose pose;
  static void fields(auto field) {
    field("header", &PoseStamped::header);
    field("pose", &PoseStamped::pose);
  }
};

struct PoseWithCovariance {
  static constexpr std::string_view type_name = "geometry_msgs/PoseWithCovariance";
  Pose pose;
  std::array<double, 36> covariance{};
  static void fields(auto field) {
    field("pose", &PoseWithCovariance::pose);
    field("covariance", &PoseWithCovariance::covariance);
  }
};

struct PoseWithCovarianceStamped {
  static constexpr std::string_view type_name = "geometry_msgs/PoseWithCovarianceStamped";
  std_msgs::Header header;
  PoseWithCovariance pose;
  static void fields(auto field) {
    field("header", &PoseWithCovarianceStamped::header);
    field("pose", &PoseWithCovarianceStamped::pose);
  }
};

struct PoseArray {
  static constexpr std::string_view type_name = "geometry_msgs/PoseArray";
  std_msgs::Header header;
  std::vector<Pose> poses;
  static void fields(auto field) {
    field("header", &PoseArray::header);
    field("poses", &PoseArray::poses);
  }
};

struct Transform {
  static constexpr std::string_view type_name = "geometry_msgs/Transform";
  Vector3 translation;
  Quaternion rotation;
  static void fields(auto field) {
    field("translation", &Transform::translation);
    field("rotation", &Transform::rotation);
  }
};

struct TransformStamped {
  static constexpr std::string_view type_name = "geometry_msgs/TransformStamped";
  std_msgs::Header header;
  std::string child_frame_id;
  Transform transform;
  static void fields(auto field) {
    field("header", &TransformStamped::header);
    field("child_frame_id", &TransformStamped::child_frame_id);
    field("transform", &TransformStamped::transform);
  }
};

struct Twist {
  static constexpr std::string_view type_name = "geometry_msgs/Twist";
  Vector3 linear;
  Vector3 angular;
  static void fields(auto field) {
    field("linear", &Twist::linear);
    field("angular", &Twist::angular);
  }
};

struct TwistWithCovariance {
  static constexpr std::string_view type_name = "geometry_msgs/TwistWithCovariance";
  Twist twist;
  std::array<double, 36> covariance{};
  static void fields(auto field) {
    field("twist", &TwistWithCovariance::twist);
    field("covariance", &TwistWithCovariance::covariance);
  }
};

}  // namespace waitpoint::messages::geometry_msgs
