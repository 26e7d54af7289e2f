// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fit/odometry_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "tools/fit/median.hpp"

namespace waitpoint::tools {
namespace {

constexpr double lengths_m[] = {1, 2, 4, 8};
constexpr double travel_least_m = 40;
constexpr double robust = 1.4826;  // of the median deviation of a normal distribution
constexpr double deviations_max = 5;
// Squared turns that show their scale: summed over the stretches, and of each in the mean.
constexpr double turns_least_rad2 = 1, turn_least_rad2 = 0.02;
constexpr double at_rest_m = 0.02, at_rest_rad = 0.01;  // shorter steps are of the localisation's noise

/// Adds a motion, its travel along the mean heading.
void add_step(const Pose& step, double& travel_m, double& turn_rad) {
  const auto [s, c] = exact::sincos(step.heading / 2);
  travel_m += step.x * c + step.y * s;
  turn_rad += step.heading;
}

/// Steps in which the robot moves clearly: so that the noise of each pose does not add up to travel.
std::vector<std::size_t> steps_of(std::span<const Pose> measured) {
  std::vector<std::size_t> ends = {0};
  for (std::size_t i = 1; i < measured.size(); ++i) {
    const Pose step = between(measured[ends.back()], measured[i]);
    if (length(step.position()) >= at_rest_m || std::fabs(step.heading) >= at_rest_rad) ends.push_back(i);
  }
  return ends;
}

/// The bound of residuals that count.
double bound_of(const std::vector<double>& residuals) {
  const double centre = median(residuals);
  std::vector<double> off;
  off.reserve(residuals.size());
  for (const double residual : residuals) off.push_back(std::fabs(residual - centre));
  return deviations_max * robust * median(off) + std::fabs(centre);
}

/// Least squares of up to three unknowns, summed row by row: the order of Eigen's products of large matrices depends on
/// the processor's caches.
class LeastSquares {
 public:
  void add(const Eigen::Vector3d& row, double target) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index k = 0; k < 3; ++k) normal_(i, k) += row(i) * row(k);
      right_(i) += row(i) * target;
    }
  }
  /// Unknowns without rows are 0. `positive`: so are those that would be negative.
  Eigen::Vector3d solve(bool positive) const {
    Eigen::Matrix3d normal = normal_;
    Eigen::Vector3d right = right_, solution = Eigen::Vector3d::Zero();
    for (int unknowns = 3; unknowns > 0; --unknowns) {
      for (Eigen::Index i = 0; i < 3; ++i) normal(i, i) += least_weight;
      solution = normal.ldlt().solve(right);
      Eigen::Index least = 0;
      for (Eigen::Index i = 1; i < 3; ++i)
        if (solution(i) < solution(least)) least = i;
      if (!positive || solution(least) >= 0) return solution;
      for (Eigen::Index i = 0; i < 3; ++i) normal(i, least) = normal(least, i) = 0;
      right(least) = 0;
    }
    return solution.cwiseMax(0);
  }

 private:
  static constexpr double least_weight = 1e-12;

  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
};

/// A residual with the stretch that it is of.
struct Residual {
  double value, travel_m, turns_rad;
};

std::string metres(double length_m) { return fmt::format("{:.1f} m", length_m); }

/// The squared residuals by a constant, travel and turns; relative to their own scale, which grows with the stretch.
Eigen::Vector3d variances(const std::vector<Residual>& residuals, bool by_turns) {
  LeastSquares squares;
  for (const Residual& residual : residuals) {
    const double weight = 1 / (1 + residual.travel_m);
    squares.add({weight, weight * residual.travel_m, by_turns ? weight * residual.turns_rad : 0},
                weight * residual.value * residual.value);
  }
  return squares.solve(true);
}

bool is_corrected(const Stretch& of) {
  constexpr double least_m = 1e-4, least_rad = 1e-4;  // the localisation's own noise is greater
  return std::fabs(of.measured_travel_m - of.travel_m) > least_m ||
         std::fabs(of.measured_turn_rad - of.turn_rad) > least_rad;
}

/// The scale of turns from those of stretches, beside a drift that grows with the travel.
double shown_turns(const std::vector<Stretch>& stretches) {
  double turns = 0, both = 0, travels = 0;
  for (const Stretch& of : stretches) {
    turns += of.turn_rad * of.turn_rad;
    both += of.turn_rad * of.travel_m;
    travels += of.travel_m * of.travel_m;
  }
  return travels > 0 ? turns - both * both / travels : turns;
}

class Fit {
 public:
  Fit(std::span<const Pose> measured, std::span<const Pose> localised) {
    for (const double length_m : lengths_m) {
      all_.push_back(stretches_of(measured, localised, length_m));
      result_.uncorrected += std::erase_if(all_.back(), [](const Stretch& of) { return !is_corrected(of); });
    }
  }

  double corrected_m() const { return lengths_m[0] * static_cast<double>(all_.front().size()); }

  OdometryFit fit() {
    fit_systematic(all_.back());  // of the longest, in which the localisation's errors weigh least
    std::vector<Residual> travel, turn;
    for (const std::vector<Stretch>& stretches : all_) add_residuals(stretches, travel, turn);
    const Eigen::Vector3d of_travel = variances(travel, false), of_turn = variances(turn, true);
    result_.travel_noise_m_per_sqrt_m = std::sqrt(of_travel(1));
    result_.turn_noise_rad_per_sqrt_m = std::sqrt(of_turn(1));
    result_.turn_noise_rad_per_sqrt_rad = std::sqrt(of_turn(2));
    return result_;
  }

 private:
  double travel_residual(const Stretch& of) const { return of.measured_travel_m - result_.travel_scale * of.travel_m; }
  double turn_residual(const Stretch& of) const {
    return of.measured_turn_rad - result_.turn_scale * of.turn_rad - result_.drift_rad_per_m * of.travel_m;
  }

  void fit_systematic(const std::vector<Stretch>& stretches) {
    std::vector<double> ratios, turns;
    for (const Stretch& of : stretches) ratios.push_back(of.travel_m > 0 ? of.measured_travel_m / of.travel_m : 1);
    result_.travel_scale = median(ratios);
    for (const Stretch& of : stretches) turns.push_back(turn_residual(of));
    const double bound = bound_of(turns);
    std::vector<Stretch> within;
    for (std::size_t i = 0; i < stretches.size(); ++i)
      if (std::fabs(turns[i]) <= bound) within.push_back(stretches[i]);
    const double shown_rad2 = shown_turns(within);
    result_.turns_seen =
        shown_rad2 > turns_least_rad2 && shown_rad2 > turn_least_rad2 * static_cast<double>(within.size());
    LeastSquares squares;
    for (const Stretch& of : within)
      squares.add({result_.turns_seen ? of.turn_rad : 0, of.travel_m, 0}, of.measured_turn_rad - of.turn_rad);
    const Eigen::Vector3d solution = squares.solve(false);
    result_.turn_scale = 1 + solution(0);
    result_.drift_rad_per_m = solution(1);
  }

  void add_residuals(const std::vector<Stretch>& stretches, std::vector<Residual>& travel,
                     std::vector<Residual>& turn) {
    std::vector<double> of_travel, of_turn;
    for (const Stretch& of : stretches) {
      of_travel.push_back(travel_residual(of));
      of_turn.push_back(turn_residual(of));
    }
    const double travel_bound = bound_of(of_travel), turn_bound = bound_of(of_turn);
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const Stretch& of = stretches[i];
      ++result_.stretches;
      if (std::fabs(of_travel[i]) > travel_bound || std::fabs(of_turn[i]) > turn_bound) {
        ++result_.left_out;
        continue;
      }
      travel.push_back({of_travel[i], of.travel_m, of.turns_rad});
      turn.push_back({of_turn[i], of.travel_m, of.turns_rad});
    }
  }

  std::vector<std::vector<Stretch>> all_;  // by length
  OdometryFit result_;
};

}  // namespace

std::vector<Stretch> stretches_of(std::span<const Pose> measured, std::span<const Pose> localised, double length_m) {
  std::vector<Stretch> stretches;
  Stretch stretch;
  const std::vector<std::size_t> steps = steps_of(measured);
  double gone_m = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    const Pose own = between(localised[steps[i - 1]], localised[steps[i]]);
    const Pose odometry = between(measured[steps[i - 1]], measured[steps[i]]);
    add_step(own, stretch.travel_m, stretch.turn_rad);
    add_step(odometry, stretch.measured_travel_m, stretch.measured_turn_rad);
    stretch.turns_rad += std::fabs(odometry.heading);
    gone_m += length(odometry.position());
    if (gone_m < length_m) continue;
    stretches.push_back(stretch);
    stretch = {};
    gone_m = 0;
  }
  return stretches;
}

OdometryFit fit_odometry(std::span<const Pose> measured, std::span<const Pose> localised, const std::string& file) {
  WAITPOINT_CHECK(measured.size() == localised.size(), "poses of other times are compared");
  double travel_m = 0;
  for (std::size_t i = 1; i < measured.size(); ++i)
    travel_m += length(measured[i].position() - measured[i - 1].position());
  if (travel_m < travel_least_m)
    throw BadInput(file, "expected at least 40 m of travel that were localised, found " + metres(travel_m));
  Fit fit(measured, localised);
  if (fit.corrected_m() < travel_least_m)
    throw BadInput(file, "expected at least 40 m over which the scans correct the odometry, found " +
                             metres(fit.corrected_m()) + ": the localisation stood still, or saw nothing");
  return fit.fit();
}

}  // namespace waitpoint::tools
