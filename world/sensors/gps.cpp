// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/gps.hpp"

#include <cmath>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

constexpr std::uint64_t height_axis = 2;

}  // namespace

Gps::Model::Draws::Draws(std::uint64_t seed, std::string_view robot)
    : drift(seed, robot, "gps.drift"), noise(seed, robot, "gps.noise"), dropout(seed, robot, "gps.dropout") {}

Gps::Model::Model(const Description& description, std::uint64_t seed, std::string_view robot)
    : description_(description),
      draws_(seed, robot),
      kept_(exact::exp(-description.period.seconds() / description.drift_s)) {
  WAITPOINT_CHECK(0 <= kept_ && kept_ <= 1, "a receiver's drift grows: its period or its correlation time is negative");
  for (std::uint64_t axis = 0; axis < wandered_m_.size(); ++axis)
    wandered_m_[axis] = description_.drift_m * draws_.drift.normal(0, axis);
}

double Gps::Model::measured(std::uint64_t axis, double true_m) const {
  const Description& d = description_;
  const double error_m = wandered_m_[axis] + d.noise_m * draws_.noise.normal(tries_, axis);
  const double position_m = true_m + (axis == height_axis ? d.height_factor * error_m : error_m);
  return d.resolution_m > 0 ? std::nearbyint(position_m / d.resolution_m) * d.resolution_m : position_m;
}

void Gps::Model::moved(const StepDone& step, const BodyState& body) {
  const Description& d = description_;
  // Of several tries in one step only the last gives a fix; the drift advances with each.
  const std::int64_t due = step.now / d.period - (step.now - step.length) / d.period;
  WAITPOINT_FAST_CHECK(due >= 0, "the time of a receiver goes back");
  for (std::int64_t n = 0; n < due; ++n) {
    ++tries_;
    for (std::uint64_t axis = 0; axis < wandered_m_.size(); ++axis)
      wandered_m_[axis] =
          kept_ * wandered_m_[axis] + d.drift_m * std::sqrt(1 - kept_ * kept_) * draws_.drift.normal(tries_, axis);
  }
  if (due == 0 || draws_.dropout.uniform(tries_) < d.dropout) return;
  const Pose& pose = body.pose;
  const auto [s, c] = exact::sincos(pose.heading);
  const Point antenna = {pose.x + c * d.antenna.x - s * d.antenna.y, pose.y + s * d.antenna.x + c * d.antenna.y};
  ++fix_.number;
  fix_.position = {measured(0, antenna.x + d.bias_x_m), measured(1, antenna.y + d.bias_y_m)};
  fix_.height_m = measured(height_axis, body.height_m);
}

}  // namespace waitpoint::world
