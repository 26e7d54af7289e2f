// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/imu.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace waitpoint::world {

Imu::Model::Axis::Draws::Draws(std::uint64_t seed, std::string_view robot, const std::string& name)
    : noise(seed, robot, name + ".noise"), walk(seed, robot, name + ".walk"), drift(seed, robot, name + ".drift") {}

Imu::Model::Axis::Axis(const InertialErrors& errors, std::uint64_t seed, std::string_view robot,
                       const std::string& name)
    : errors_(errors),
      name_(name),
      draws_(seed, robot, name),
      bias_(errors.bias * RandomStream(seed, robot, name + ".bias").normal(0)),
      wandered_(errors.drift * draws_.drift.normal(0)) {}

double Imu::Model::Axis::take(std::uint64_t number, double elapsed_s) {
  WAITPOINT_FAST_CHECK(elapsed_s > 0, "a sample is a mean over no time");
  const InertialErrors& e = errors_;
  const double root_s = std::sqrt(elapsed_s);
  double reading = e.scale * (sum_ / elapsed_s) + bias_ + wandered_;
  sum_ = 0;
  if (e.noise_per_sqrt_hz > 0) reading += e.noise_per_sqrt_hz / root_s * draws_.noise.normal(number);
  if (e.walk_per_sqrt_s > 0) bias_ += e.walk_per_sqrt_s * root_s * draws_.walk.normal(number);
  if (e.drift > 0) {
    const double kept = exact::exp(-elapsed_s / e.drift_s);
    wandered_ = kept * wandered_ + e.drift * std::sqrt(1 - kept * kept) * draws_.drift.normal(number);
  }
  if (e.max > 0) reading = std::clamp(reading, -e.max, e.max);
  return e.resolution > 0 ? std::nearbyint(reading / e.resolution) * e.resolution : reading;
}

Imu::Model::Model(const Description& description, std::uint64_t seed, std::string_view robot)
    : period_(description.period),
      gyro_(description.gyro, seed, robot, "imu.gyro"),
      ahead_(description.accelerometer, seed, robot, "imu.ahead"),
      left_(description.accelerometer, seed, robot, "imu.left"),
      up_(description.accelerometer, seed, robot, "imu.up") {
  WAITPOINT_CHECK(period_ > Duration(), "an inertial unit has no positive period");
  for (const InertialErrors& errors : {description.gyro, description.accelerometer})
    WAITPOINT_CHECK(!(errors.drift > 0) || errors.drift_s > 0, "a drift has no positive correlation time");
}

void Imu::Model::reseed(std::uint64_t seed, std::string_view robot) {
  for (Axis* axis : {&gyro_, &ahead_, &left_, &up_}) axis->reseed(seed, robot);
}

void Imu::Model::moved(const StepDone& step, const BodyState& body) {
  WAITPOINT_FAST_CHECK(step.length > Duration() && step.now >= step.length,
                       "a step of an inertial unit begins before time 0");
  const Arc& arc = body.arc;
  const Velocity& velocity = body.velocity;
  const double step_s = step.length.seconds();
  const double turn_rad_s = arc.turn_rad / step_s;
  gyro_.add(arc.turn_rad);
  // Velocities are in the body's frame, which rotates.
  ahead_.add(velocity.v_m_s - velocity_.v_m_s - arc.side_m * turn_rad_s);
  left_.add(velocity.side_m_s - velocity_.side_m_s + arc.distance_m * turn_rad_s);
  up_.add(velocity.climb_m_s - velocity_.climb_m_s + gravity_m_s2 * step_s);
  velocity_ = velocity;
  summed_ += step.length;
  if (step.now / period_ == (step.now - step.length) / period_) return;
  const double elapsed_s = summed_.seconds();
  summed_ = Duration();
  const std::uint64_t number = ++sample_.number;
  sample_.turn_rad_s = gyro_.take(number, elapsed_s);
  sample_.ahead_m_s2 = ahead_.take(number, elapsed_s);
  sample_.left_m_s2 = left_.take(number, elapsed_s);
  sample_.up_m_s2 = up_.take(number, elapsed_s);
  sample_.turned_rad += sample_.turn_rad_s * elapsed_s;
}

}  // namespace waitpoint::world
