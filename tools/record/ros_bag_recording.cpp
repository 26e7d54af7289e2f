// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/ros_bag_recording.hpp"

#include <exception>

#include "core/error.hpp"
#include "modules/messages/poses.hpp"
#include "modules/messages/readings.hpp"
#include "modules/messages/rosgraph_msgs.hpp"
#include "modules/messages/tf2_msgs.hpp"
#include "modules/messages/visualization_msgs.hpp"
#include "modules/messages/wire.hpp"
#include "tools/record/reading_message.hpp"

namespace waitpoint::tools {
namespace {

using messages::visualization_msgs::Marker;

/// A grey box, or an upright cylinder.
Marker marker_of(const world::Shape& shape, const std::string& frame) {
  Marker marker;
  marker.header = messages::header_of(Time(), frame);
  marker.pose = messages::pose_message(shape.pose, (shape.z_low_m + shape.z_high_m) / 2);
  const double height_m = shape.z_high_m - shape.z_low_m;
  if (shape.kind == world::Shape::Kind::cylinder) {
    marker.type = messages::constant<Marker>("CYLINDER");
    marker.scale = {2 * shape.radius_m, 2 * shape.radius_m, height_m};
  } else {
    marker.type = messages::constant<Marker>("CUBE");
    marker.scale = {shape.length_m, shape.width_m, height_m};
  }
  marker.color = {0.6f, 0.6f, 0.6f, 1};
  return marker;
}

}  // namespace

RosBagRecording::RosBagRecording(const std::filesystem::path& path, const scenario::Scenario& scenario)
    : ViewerRecording(path, scenario), file_(path) {
  const std::string name = path.string();
  const BagLibrary& library = bag_library(name);
  try {
    bag_ = library.make(file_.written_to().string());
  } catch (const std::exception& failure) {
    throw BadInput(name, std::string("cannot be written: ") + failure.what());
  }
}

template <messages::Message M>
void RosBagRecording::write(const std::string& topic, const M& message) {
  bag_->write(topic, messages::stamp_of(now_), messages::ros1_type<M>(),
              messages::encode<messages::Wire::ros1>(message));
}

void RosBagRecording::write_clock() { write("/clock", messages::rosgraph_msgs::Clock{messages::stamp_of(now_)}); }

void RosBagRecording::write_obstacles(const std::vector<world::Shape>& shapes) {
  messages::visualization_msgs::MarkerArray all;
  for (const world::Shape& shape : shapes) {
    Marker& marker = all.markers.emplace_back(marker_of(shape, root));
    marker.ns = "/world";
    marker.id = static_cast<std::int32_t>(all.markers.size() - 1);
  }
  write("/world", all);
}

void RosBagRecording::write_transform(Time date, const std::string& parent, const std::string& child, const Pose& pose,
                                      double height_m) {
  write("/tf", messages::tf2_msgs::TFMessage{{messages::transform_message(date, parent, child, pose, height_m)}});
}

void RosBagRecording::write_truth(const OfRobot& robot, Time date, const Pose& pose, double height_m) {
  write("/" + robot.name + "/truth", messages::pose_message(date, root, pose, height_m));
}

void RosBagRecording::write_odometry(const OfRobot& robot, const posters::Odometry& odometry) {
  write("/" + robot.name + "/odometry", messages::message_of(odometry, root, robot.name));
}

void RosBagRecording::write_position(const OfRobot& robot, const posters::PositionEstimate& position) {
  write("/" + robot.name + "/position", messages::message_of(position, root));
}

void RosBagRecording::write_reading(const AnyNewReading& any) {
  using messages::messages_of;
  std::visit(
      [&](const auto& of) {
        if constexpr (requires { messages_of(of.description, of.reading, of.frame); })
          for (const auto& message : messages_of(of.description, of.reading, of.frame)) write(of.topic, message);
        else
          write(of.topic, reading_message(of.reading, of.frame));
      },
      any);
}

void RosBagRecording::write_shown(const nodes::ShownMessage& message, const std::string& frame) {
  switch (message.kind) {
    case nodes::ShownMessage::Kind::grid:
      if (message.grid) write(message.topic, messages::message_of(*message.grid, message.date, frame));
      return;
    case nodes::ShownMessage::Kind::path: {
      messages::nav_msgs::Path path{messages::header_of(message.date, frame), {}};
      for (const Pose& pose : message.poses) path.poses.push_back(messages::pose_message(message.date, frame, pose));
      return write(message.topic, path);
    }
    case nodes::ShownMessage::Kind::cloud: {
      messages::geometry_msgs::PoseArray cloud{messages::header_of(message.date, frame), {}};
      for (const Pose& pose : message.poses) cloud.poses.push_back(messages::pose_message(pose));
      return write(message.topic, cloud);
    }
  }
}

void RosBagRecording::write_line(const std::string& topic, Time date, const std::string& writer,
                                 const std::string& text, bool is_warning) {
  using messages::rosgraph_msgs::Log;
  Log log;
  log.header = messages::header_of(date, "");
  log.level = is_warning ? messages::constant<Log>("WARN") : messages::constant<Log>("INFO");
  log.name = writer;
  log.msg = text;
  write(topic, log);
}

void RosBagRecording::write_log(const OfRobot& robot, const ModuleLog::Line& line) {
  write_line("/" + robot.name + "/modules", line.date, robot.name + "/" + line.module, line.text, line.is_bad);
}

void RosBagRecording::close(const bridge::RunResult& result) {
  if (result.outcome == bridge::Outcome::crashed)
    write_line("/waitpoint", Time() + result.simulated, "waitpoint", "cut off: " + result.trouble, true);
  bag_->close();
  file_.commit();
}

}  // namespace waitpoint::tools
