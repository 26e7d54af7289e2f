// SPDX-License-Identifier: BSD-3-Clause
#include "tests/modules/ndd/closed_loop.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::test {
namespace {

constexpr double step_s = 0.01, v_acceleration = 1.0, w_acceleration = 3.0;
constexpr double range_max_m = 32, noise_m = 0.005;
constexpr std::size_t beams = 361;
const Pose laser_mount = {0.1, 0, 0};

double towards(double value, double target, double change_max) {
  return value + std::clamp(target - value, -change_max, change_max);
}

double range_to_box(Point from, double angle_rad, const Box& box, double range_m) {
  const Pose ray = between(box.pose, {from.x, from.y, angle_rad});
  const auto [s, c] = exact::sincos(ray.heading);
  double enter = 0, leave = range_m;
  const auto cut = [&](double origin, double direction, double half) {
    if (direction == 0) {
      if (std::fabs(origin) > half) leave = -1;
      return;
    }
    const double a = (-half - origin) / direction, b = (half - origin) / direction;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  };
  cut(ray.x, c, 0.5 * box.length_m);
  cut(ray.y, s, 0.5 * box.width_m);
  return enter <= leave ? enter : range_m;
}

}  // namespace

double range_to_disc(Point from, Point direction, const Disc& disc, double range_m) {
  const Point d = disc.centre - from;
  const double along = dot(d, direction), aside = cross(direction, d);
  const double square = disc.radius_m * disc.radius_m - aside * aside;
  if (square < 0 || along < 0) return range_m;
  return std::min(range_m, std::max(0.0, along - std::sqrt(square)));
}

void Shapes::wall(double x0, double y0, double x1, double y1) {
  boxes.push_back({{0.5 * (x0 + x1), 0.5 * (y0 + y1), 0}, std::fabs(x1 - x0), std::fabs(y1 - y0)});
}

double Shapes::range(Point from, double angle_rad, double range_m) const {
  const auto [s, c] = exact::sincos(angle_rad);
  for (const Box& box : boxes) range_m = range_to_box(from, angle_rad, box, range_m);
  for (const Disc& disc : discs) range_m = range_to_disc(from, {c, s}, disc, range_m);
  return range_m;
}

double Shapes::clearance(Point point, double limit_m) const {
  for (const Box& box : boxes) {
    const Pose p = between(box.pose, {point.x, point.y, 0});
    const double dx = std::fabs(p.x) - 0.5 * box.length_m, dy = std::fabs(p.y) - 0.5 * box.width_m;
    const double outside = exact::hypot(std::max(dx, 0.0), std::max(dy, 0.0));
    limit_m = std::min(limit_m, outside > 0 ? outside : std::max(dx, dy));
  }
  for (const Disc& disc : discs) limit_m = std::min(limit_m, length(point - disc.centre) - disc.radius_m);
  return limit_m;
}

DrivenRobot::DrivenRobot(std::string robot_name, const ndd::Parameters& parameters, const Pose& at)
    : name(std::move(robot_name)), navigator(parameters), pose(at), start(at), noise(0, name, "laser") {}

DrivenRobot& ClosedLoop::add(const ndd::Parameters& parameters, const Pose& start) {
  const std::size_t index = robots.size();
  robots.push_back(std::make_unique<DrivenRobot>("r" + std::to_string(index), parameters, start));
  DrivenRobot& robot = *robots.back();
  robot.noise = RandomStream(seed_, robot.name, "laser");
  robot.phase = static_cast<std::int64_t>(3 * index % 10);
  return robot;
}

posters::PositionEstimate ClosedLoop::position(const DrivenRobot& robot) const {
  posters::PositionEstimate estimate;
  estimate.date = now_;
  estimate.pose = {robot.pose.x + robot.position_error.x, robot.pose.y + robot.position_error.y,
                   exact::wrap_angle(robot.pose.heading + robot.position_error.heading)};
  return estimate;
}

void ClosedLoop::go(DrivenRobot& robot, const std::vector<Point>& via_points) {
  robot.navigator.go(now_, position(robot), via_points);
  robot.decision.outcome = ndd::RouteState::driving;
}

void ClosedLoop::move(DrivenRobot& robot) {
  robot.v_m_s = towards(robot.v_m_s, robot.command.v_m_s, v_acceleration * step_s);
  robot.w_rad_s = towards(robot.w_rad_s, robot.command.w_rad_s, w_acceleration * step_s);
  const double turn = robot.w_rad_s * step_s;
  const auto [s, c] = exact::sincos(robot.pose.heading + 0.5 * turn);
  robot.pose.x += robot.v_m_s * step_s * c;
  robot.pose.y += robot.v_m_s * step_s * s;
  robot.pose.heading = exact::wrap_angle(robot.pose.heading + turn);
  robot.driven_m += robot.v_m_s * step_s;
  robot.turned_rad += std::fabs(turn);
  if (robot.v_m_s > 0.2 && std::fabs(robot.w_rad_s) > 0.1) {
    if (robot.w_rad_s * robot.last_turn < 0) ++robot.turn_changes;
    robot.last_turn = robot.w_rad_s;
  }
}

void ClosedLoop::scan(DrivenRobot& robot) {
  posters::LaserReading& reading = robot.echoes_to_be.scan;
  robot.echoes_to_be.mount = laser_mount;
  reading.date = now_;
  ++reading.number;
  reading.angle_step_rad = exact::pi / (beams - 1);
  reading.first_angle_rad = -0.5 * exact::pi;
  reading.range_max_m = range_max_m;
  reading.range_m.resize(beams);
  const Pose device = compose(robot.pose, laser_mount);
  for (std::size_t i = 0; i < beams; ++i) {
    const double angle = device.heading + reading.first_angle_rad + static_cast<double>(i) * reading.angle_step_rad;
    const auto [s, c] = exact::sincos(angle);
    double range = surroundings_.range(device.position(), angle, range_max_m);
    for (const auto& other : robots) {
      if (other.get() == &robot) continue;
      const double radius = other->navigator.parameters().robot_radius_m;
      range = range_to_disc(device.position(), {c, s}, {other->pose.position(), radius}, range);
    }
    if (range < range_max_m) {
      const double noisy = range + noise_m * robot.noise.normal_pair(reading.number, i / 2)[i % 2];
      range = std::max(0.0, std::nearbyint(100 * noisy) / 100);
    }
    reading.range_m[i] = static_cast<float>(range);
  }
}

void ClosedLoop::decide(DrivenRobot& robot) {
  const ndd::Decision decision = robot.navigator.decide(now_, position(robot));
  robot.command_to_be = decision.speeds;
  if (decision.outcome != ndd::RouteState::idle) robot.decision = decision;
}

void ClosedLoop::measure_clearance(DrivenRobot& robot) {
  const double radius = robot.navigator.parameters().robot_radius_m;
  double clearance = surroundings_.clearance(robot.pose.position(), 5.0) - radius;
  for (const auto& other : robots) {
    if (other.get() == &robot) continue;
    const double between_hulls =
        length(other->pose.position() - robot.pose.position()) - radius - other->navigator.parameters().robot_radius_m;
    clearance = std::min(clearance, between_hulls);
  }
  robot.least_clearance_m = std::min(robot.least_clearance_m, clearance);
}

void ClosedLoop::step() {
  for (const auto& robot : robots) move(*robot);
  now_ = now_ + Duration(std::chrono::milliseconds(10));
  ++steps_;
  for (const auto& r : robots) {
    DrivenRobot& robot = *r;
    measure_clearance(robot);
    if (steps_ % 2 == 0) {
      posters::Odometry odometry;
      odometry.position.date = now_;
      odometry.position.pose = between(robot.start, robot.pose);
      odometry.v_m_s = robot.v_m_s;
      odometry.w_rad_s = robot.w_rad_s;
      robot.navigator.add_odometry(odometry);
    }
    const std::int64_t turn = (steps_ + robot.phase) % 10;
    if (turn == 0) scan(robot);
    if (turn == 3) robot.navigator.add_echoes(robot.echoes = robot.echoes_to_be);
    if (turn == 6) decide(robot);
    if (turn == 8) robot.command = robot.command_to_be;
    if (turn == 9) robot.path.push_back(robot.pose);
  }
}

bool ClosedLoop::run(double seconds_max) {
  const auto steps_max = static_cast<std::int64_t>(seconds_max / step_s);
  for (std::int64_t i = 0; i < steps_max; ++i) {
    step();
    bool over = true, all = true;
    for (const auto& robot : robots) {
      over = over && robot->decision.outcome != ndd::RouteState::driving;
      all = all && robot->decision.outcome == ndd::RouteState::arrived;
    }
    if (over) return all;
  }
  return false;
}

}  // namespace waitpoint::test
