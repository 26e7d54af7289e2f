// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/ros_bag_recording.hpp"

#include <exception>

#include "core/error.hpp"
#include "core/exact_math.hpp"

namespace waitpoint::tools {
namespace {

RosBagFile::Place place(Time time, const std::string& frame, const Pose& pose, double z_m = 0) {
  const auto [sin_half, cos_half] = exact::sincos(pose.heading / 2);
  return {time.ns(), frame, pose.x, pose.y, z_m, sin_half, cos_half};
}

RosBagFile::Solid solid(const world::Shape& shape, const std::string& frame) {
  const double height_m = shape.z_high_m - shape.z_low_m;
  const RosBagFile::Place middle = place(Time(), frame, shape.pose, (shape.z_low_m + shape.z_high_m) / 2);
  if (shape.kind == world::Shape::Kind::cylinder)
    return {false, middle, {2 * shape.radius_m, 2 * shape.radius_m, height_m}};
  return {true, middle, {shape.length_m, shape.width_m, height_m}};
}

RosBagFile::Grid grid(Time time, const std::string& frame, const OccupancyGrid& of) {
  constexpr std::int8_t free = 0, occupied = 100, unknown = -1;
  RosBagFile::Grid all{place(time, frame, of.origin()), of.width(), of.height(), of.resolution_m(), {}};
  all.cells.reserve(of.cells().size());
  for (const Cell cell : of.cells())
    all.cells.push_back(cell == Cell::free ? free : cell == Cell::occupied ? occupied : unknown);
  return all;
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

void RosBagRecording::write_obstacles(const std::vector<world::Shape>& shapes) {
  std::vector<RosBagFile::Solid> solids;
  solids.reserve(shapes.size());
  for (const world::Shape& shape : shapes) solids.push_back(solid(shape, root));
  bag_->write_solids("/world", solids);
}

void RosBagRecording::write_transform(Time date, const std::string& parent, const std::string& child, const Pose& pose,
                                      double height_m) {
  bag_->write_transform(place(date, parent, pose, height_m), child);
}

void RosBagRecording::write_truth(const OfRobot& robot, Time date, const Pose& pose, double height_m) {
  bag_->write_pose("/" + robot.name + "/truth", place(date, root, pose, height_m));
}

void RosBagRecording::write_odometry(const OfRobot& robot, const posters::Odometry& odometry) {
  const posters::PositionEstimate& position = odometry.position;
  bag_->write_odometry("/" + robot.name + "/odometry", place(position.date, root, position.pose, odometry.height_m),
                       position.covariance, robot.name, odometry.v_m_s, odometry.w_rad_s);
}

void RosBagRecording::write_position(const OfRobot& robot, const posters::PositionEstimate& position) {
  bag_->write_pose("/" + robot.name + "/position", place(position.date, root, position.pose), position.covariance);
}

void RosBagRecording::write_scan(const OfRobot&, std::size_t, const std::string& frame,
                                 const posters::LaserReading& scan) {
  bag_->write_scan("/" + frame, {scan.date.ns(),
                                 frame,
                                 scan.first_angle_rad,
                                 scan.angle_step_rad,
                                 scan.range_max_m,
                                 {scan.range_m.begin(), scan.range_m.end()}});
}

void RosBagRecording::write_shown(const nodes::ShownMessage& message, const std::string& frame) {
  if (message.kind == nodes::ShownMessage::Kind::grid) {
    if (message.grid) bag_->write_grid(message.topic, grid(message.date, frame, *message.grid));
    return;
  }
  std::vector<RosBagFile::Place> places;
  places.reserve(message.poses.size());
  for (const Pose& pose : message.poses) places.push_back(place(message.date, frame, pose));
  if (message.kind == nodes::ShownMessage::Kind::path)
    bag_->write_path(message.topic, message.date.ns(), frame, places);
  else
    bag_->write_poses(message.topic, message.date.ns(), frame, places);
}

void RosBagRecording::write_log(const OfRobot& robot, const ModuleLog::Line& line) {
  bag_->write_log("/" + robot.name + "/modules", line.date.ns(), robot.name + "/" + line.module, line.text,
                  line.is_bad);
}

void RosBagRecording::close(const bridge::RunResult& result) {
  if (result.outcome == bridge::Outcome::crashed)
    bag_->write_log("/waitpoint", result.simulated.ns(), "waitpoint", "cut off: " + result.trouble, true);
  bag_->close();
  file_.commit();
}

}  // namespace waitpoint::tools
