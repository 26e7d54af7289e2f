// SPDX-License-Identifier: BSD-3-Clause
// The result of a fictitious run with one or two robots, for tests of all output formats.
#pragma once

#include "modules/bridge/run_result.hpp"

namespace waitpoint::tools {

inline bridge::RobotResult sample_robot(const std::string& name) {
  bridge::RobotResult robot;
  robot.name = name;
  robot.digest = Digest(name.size());
  robot.shape.kind = world::Shape::Kind::cylinder;
  robot.shape.radius_m = 0.26;
  robot.goals = {{{3, 1}, "shelf", 1, 1, Time::from_ns(12'500'000'000), "reached"},
                 {{5, 4}, "", 1, 0, Time::from_ns(40'000'000'000), "no way"}};
  robot.distance_m = 10.5;
  robot.position_error_mean_m = 0.03;
  robot.position_error_max_m = 0.125;
  robot.odometry_error_max_m = 1.5;
  robot.odometry_error_end_m = 1.25;
  for (int second = 0; second <= 40; ++second) {
    const Pose truth{0.1 * second, 1, second < 20 ? 0 : exact::pi / 2};
    const Time date = Time() + second * Duration(std::chrono::seconds(1));
    robot.true_path.push_back({date, truth});
    robot.estimated_path.push_back({date, {truth.x, truth.y + 0.03, truth.heading}});
    robot.odometry_path.push_back({date, {truth.x, truth.y + 0.01 * second, truth.heading}});
  }
  robot.segments = {{{0, 0}, {4, 0}}};
  return robot;
}

inline bridge::RunResult sample_result(std::size_t robots = 1) {
  bridge::RunResult result;
  result.scenario = "a <small> \"run\" & more";
  result.seed = 7;
  result.digest = Digest(1);
  result.environment_digest = Digest(2);
  result.robots.push_back(sample_robot("one"));
  if (robots > 1) result.robots.push_back(sample_robot("second"));
  result.outcome = bridge::Outcome::time_limit;
  result.events = 12345;
  result.simulated = std::chrono::seconds(40);
  result.wall_s = 0.5;
  result.real_time_factor = 80;
  return result;
}

}  // namespace waitpoint::tools
