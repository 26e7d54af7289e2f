// SPDX-License-Identifier: BSD-3-Clause
#include "modules/locate/tracker.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::locate {

using posters::invert;
using posters::Matrix3;

void Tracker::predict(const Pose& motion) {
  const double travel_m = length(motion.position()), turn_rad = std::fabs(motion.heading);
  travel_m_ += travel_m;
  turn_rad_ += turn_rad;
  posters::UncertainPose step = {motion, {}};
  step.covariance[0] = step.covariance[4] = exact::square(parameters_.travel_noise_m_per_sqrt_m) * travel_m;
  step.covariance[8] = exact::square(parameters_.drift_noise_rad_per_sqrt_m) * travel_m +
                       exact::square(parameters_.turn_noise_rad_per_sqrt_rad) * turn_rad;
  estimate_ = compose(estimate_, step);
}

bool Tracker::update(std::span<const matching::SurfacePoint> scan) {
  const bool rests = travel_m_ < parameters_.rest_m && turn_rad_ < parameters_.rest_rad;
  if (scan.empty() || (rests && unexplained_ == 0 && ++rest_ < parameters_.rest_scans)) return false;
  rest_ = 0;
  travel_m_ = turn_rad_ = 0;
  Matrix3 prior;
  if (!invert(estimate_.covariance, prior)) prior = {};
  matching::RefinementParameters refinement;
  const matching::Refined refined = refine(map_, scan, estimate_.pose, prior, refinement);
  explained_ = refined.explained;
  if (explained_ < parameters_.explained_min) {
    unexplained_ = std::min(unexplained_ + 1, parameters_.lost_scans);
    return false;
  }
  unexplained_ = 0;
  estimate_.pose = refined.pose;
  for (std::size_t i = 0; i < prior.size(); ++i) prior[i] += parameters_.independent_share * refined.information[i];
  if (Matrix3 covariance; invert(prior, covariance)) estimate_.covariance = covariance;
  const double floor_m2 = exact::square(parameters_.position_floor_m);
  for (const std::size_t i : {0, 4}) estimate_.covariance[i] = std::max(estimate_.covariance[i], floor_m2);
  estimate_.covariance[8] = std::max(estimate_.covariance[8], exact::square(parameters_.heading_floor_rad));
  return true;
}

}  // namespace waitpoint::locate
