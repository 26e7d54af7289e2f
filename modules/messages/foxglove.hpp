// SPDX-License-Identifier: BSD-3-Clause
// Messages of Foxglove's viewers (docs.foxglove.dev, "Foxglove schemas"), in JSON. Lengths in metres, angles in
// radians, rotations as quaternions; times are virtual, from 0.
#pragma once

#include "modules/messages/geometry_msgs.hpp"
#include "modules/messages/message.hpp"

namespace waitpoint::messages::foxglove {

/// The virtual time in ROS's format; Foxglove has no schema for it.
struct Clock {
  static constexpr std::string_view type_name = "waitpoint.Clock";
  Stamp clock;
  static void fields(auto field) { field("clock", &Clock::clock); }
};

struct FrameTransform {
  static constexpr std::string_view type_name = "foxglove.FrameTransform";
  Stamp timestamp;
  std::string parent_frame_id, child_frame_id;
  geometry_msgs::Vector3 translation;
  geometry_msgs::Quaternion rotation;
  static void fields(auto field) {
    field("timestamp", &FrameTransform::timestamp);
    field("parent_frame_id", &FrameTransform::parent_frame_id);
    field("child_frame_id", &FrameTransform::child_frame_id);
    field("translation", &FrameTransform::translation);
    field("rotation", &FrameTransform::rotation);
  }
};

struct LaserScan {
  static constexpr std::string_view type_name = "foxglove.LaserScan";
  Stamp timestamp;
  std::string frame_id;
  geometry_msgs::Pose pose;
  double start_angle = 0, end_angle = 0;
  std::vector<double> ranges, intensities;
  static void fields(auto field) {
    field("timestamp", &LaserScan::timestamp);
    field("frame_id", &LaserScan::frame_id);
    field("pose", &LaserScan::pose, optional);
    field("start_angle", &LaserScan::start_angle);
    field("end_angle", &LaserScan::end_angle);
    field("ranges", &LaserScan::ranges);
    field("intensities", &LaserScan::intensities, optional);
  }
};

/// A line of text.
struct Log {
  static constexpr std::string_view type_name = "foxglove.Log";
  static constexpr Constant<std::int32_t> constants[] = {{"INFO", 2}, {"WARNING", 3}};
  Stamp timestamp;
  std::int32_t level = 0;
  std::string message, name, file;
  std::uint32_t line = 0;
  static void fields(auto field) {
    field("timestamp", &Log::timestamp);
    field("level", &Log::level);
    field("message", &Log::message);
    field("name", &Log::name);
    field("file", &Log::file);
    field("line", &Log::line);
  }
};

struct PoseInFrame {
  static constexpr std::string_view type_name = "foxglove.PoseInFrame";
  Stamp timestamp;
  std::string frame_id;
  geometry_msgs::Pose pose;
  static void fields(auto field) {
    field("timestamp", &PoseInFrame::timestamp);
    field("frame_id", &PoseInFrame::frame_id, optional);
    field("pose", &PoseInFrame::pose);
  }
};

struct PosesInFrame {
  static constexpr std::string_view type_name = "foxglove.PosesInFrame";
  Stamp timestamp;
  std::string frame_id;
  std::vector<geometry_msgs::Pose> poses;
  static void fields(auto field) {
    field("timestamp", &PosesInFrame::timestamp);
    field("frame_id", &PosesInFrame::frame_id);
    field("poses", &PosesInFrame::poses);
  }
};

struct Color {
  static constexpr std::string_view type_name = "foxglove.Color";
  double r = 0, g = 0, b = 0, a = 0;
  static void fields(auto field) {
    field("r", &Color::r);
    field("g", &Color::g);
    field("b", &Color::b);
    field("a", &Color::a);
  }
};

struct CubePrimitive {
  static constexpr std::string_view type_name = "foxglove.CubePrimitive";
  geometry_msgs::Pose pose;
  geometry_msgs::Vector3 size;
  Color color;
  static void fields(auto field) {
    field("pose", &CubePrimitive::pose);
    field("size", &CubePrimitive::size);
    field("color", &CubePrimitive::color);
  }
};

struct CylinderPrimitive {
  static constexpr std::string_view type_name = "foxglove.CylinderPrimitive";
  geometry_msgs::Pose pose;
  geometry_msgs::Vector3 size;
  double bottom_scale = 1, top_scale = 1;
  Color color;
  static void fields(auto field) {
    field("pose", &CylinderPrimitive::pose);
    field("size", &CylinderPrimitive::size);
    field("bottom_scale", &CylinderPrimitive::bottom_scale);
    field("top_scale", &CylinderPrimitive::top_scale);
    field("color", &CylinderPrimitive::color);
  }
};

struct SceneEntity {
  static constexpr std::string_view type_name = "foxglove.SceneEntity";
  Stamp timestamp;
  std::string frame_id, id;
  Span lifetime;
  bool frame_locked = false;
  std::vector<CubePrimitive> cubes;
  std::vector<CylinderPrimitive> cylinders;
  static void fields(auto field) {
    field("timestamp", &SceneEntity::timestamp);
    field("frame_id", &SceneEntity::frame_id);
    field("id", &SceneEntity::id);
    field("lifetime", &SceneEntity::lifetime);
    field("frame_locked", &SceneEntity::frame_locked);
    field("cubes", &SceneEntity::cubes);
    field("cylinders", &SceneEntity::cylinders);
  }
};

struct SceneUpdate {
  static constexpr std::string_view type_name = "foxglove.SceneUpdate";
  std::vector<SceneEntity> entities;
  static void fields(auto field) { field("entities", &SceneUpdate::entities); }
};

}  // namespace waitpoint::messages::foxglove
