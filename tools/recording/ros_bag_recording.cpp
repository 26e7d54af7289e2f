// SPDX-License-Identifier: BSD-3-Clause
#include "tools/recording/ros_bag_recording.hpp"

#include <algorithm>
#include <exception>
#include <tuple>

#include "core/error.hpp"
#include "core/exact_math.hpp"

namespace waitpoint::tools {
namespace {

constexpr Duration sampling = std::chrono::milliseconds(100);
constexpr const char* root = "world";

RosBagFile::Place place(Time time, const std::string& frame, const Pose& pose, double z_m = 0) {
  const auto [sin_half, cos_half] = exact::sincos(pose.heading / 2);
  return {time.ns(), frame, pose.x, pose.y, z_m, sin_half, cos_half};
}

RosBagFile::Solid solid(const world::Shape& shape) {
  const double height_m = shape.z_high_m - shape.z_low_m;
  const RosBagFile::Place middle = place(Time(), root, shape.pose, (shape.z_low_m + shape.z_high_m) / 2);
  if (shape.kind == world::Shape::Kind::box) return {true, middle, {shape.length_m, shape.width_m, height_m}};
  return {false, middle, {2 * shape.radius_m, 2 * shape.radius_m, height_m}};
}

// All that tells one from another; the frame and the time are the same for all.
auto identity(const RosBagFile::Solid& solid) {
  const RosBagFile::Place& place = solid.place;
  return std::tuple(solid.is_box, place.x, place.y, place.z, place.sin_half, place.cos_half, solid.size);
}

}  // namespace

RosBagRecording::RosBagRecording(const std::filesystem::path& path, const bridge::Scenario& scenario)
    : scenario_(scenario), file_(path) {
  try {
    bag_ = std::make_unique<RosBagFile>(file_.written_to().string());
  } catch (const std::exception& failure) {
    throw BadInput(path.string(), std::string("cannot be written: ") + failure.what());
  }
}

void RosBagRecording::begin(bridge::Experiment& experiment) {
  for (std::size_t i = 0; i < scenario_.robots.size(); ++i) {
    bridge::Robot& robot = *experiment.robots()[i];
    robots_.push_back({robot.name(), RobotPosters(scenario_.robots[i], robot), std::make_unique<ModuleLog>()});
    robot.set_watch(robots_.back().modules.get());
  }
}

void RosBagRecording::record(const bridge::Experiment& experiment, Time now) {
  bag_->set_time(now.ns());
  const world::World& world = experiment.world();
  const bool is_sampled = !sampled_ || now - *sampled_ >= sampling;
  if (is_sampled) {
    sampled_ = now;
    bag_->write_clock();
    record_world(world.description().obstacles);
  }
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    const std::string& name = robots_[i].name;
    if (is_sampled) {
      const world::BodyState& body = world.body(world::BodyId(static_cast<std::uint32_t>(i)));
      const RosBagFile::Place truth = place(now, root, body.pose, body.height_m);
      bag_->write_transform(truth, name);
      bag_->write_pose("/" + name + "/truth", truth);
    }
    record_robot(robots_[i]);
  }
}

void RosBagRecording::record_robot(OfRobot& robot) {
  record_modules(robot);
  const std::string believed = robot.name + "/position";
  if (const auto odometry = robot.posters.odometry()) {
    const posters::PositionEstimate& position = odometry->position;
    bag_->write_odometry("/" + robot.name + "/odometry", place(position.date, root, position.pose, odometry->height_m),
                         position.covariance, robot.name, odometry->v_m_s, odometry->w_rad_s);
  }
  if (const auto fused = robot.posters.position()) {
    const RosBagFile::Place position = place(fused->position.date, root, fused->position.pose);
    bag_->write_pose("/" + believed, position, fused->position.covariance);
    bag_->write_transform(position, believed);
  }
  for (RobotPosters::Laser& laser : robot.posters.lasers) {
    const auto scan = robot.posters.scan(laser);
    if (!scan) continue;
    const std::string frame = robot.name + "/" + laser.name;
    const world::LaserDescription& device = laser.description;
    bag_->write_transform(place(scan->date, believed, device.mount, device.height_m), frame);
    bag_->write_scan("/" + frame, {scan->date.ns(),
                                   frame,
                                   scan->first_angle_rad,
                                   scan->angle_step_rad,
                                   scan->range_max_m,
                                   {scan->range_m.begin(), scan->range_m.end()}});
  }
}

void RosBagRecording::record_modules(OfRobot& robot) {
  for (const ModuleLog::Line& line : robot.modules->take())
    bag_->write_log("/" + robot.name + "/modules", line.date.ns(), robot.name + "/" + line.module, line.text,
                    line.is_bad);
}

void RosBagRecording::record_world(const std::vector<world::Obstacle>& obstacles) {
  std::vector<RosBagFile::Solid> solids;
  for (const world::Obstacle& obstacle : obstacles) solids.push_back(solid(obstacle.shape));
  if (std::ranges::equal(solids, drawn_, {}, identity, identity)) return;
  bag_->write_solids("/world", solids);
  drawn_ = std::move(solids);
}

void RosBagRecording::commit(const bridge::RunResult&) {
  for (OfRobot& robot : robots_) record_modules(robot);
  bag_->close();
  file_.commit();
}

}  // namespace waitpoint::tools
