// SPDX-License-Identifier: BSD-3-Clause
#include "tests/modules/segloc/tour.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace waitpoint::synthetic {
namespace {

constexpr int steps_a_scan = 5;
constexpr double step_s = 0.02;

// Straight on while turning by `turn_rad` over `way_m`, in the frame of the start.
Pose small_step(double way_m, double turn_rad) {
  const auto [s, c] = exact::sincos(0.5 * turn_rad);
  return {way_m * c, way_m * s, turn_rad};
}

// What the base reports of its motion between two scans: the measured pose in the frame of the last scan's, and the
// covariance that its error model gives.
class Odometer {
 public:
  Odometer(const OdometryModel& model, std::uint64_t seed) : model_(model), noise_(seed, "r", "base.odometry") {}

  void move(double way_m, double turn_rad) {
    const auto [n0, n1] = noise_.normal_pair(tick_, 0);
    const auto [n2, n3] = noise_.normal_pair(tick_, 1);
    ++tick_;
    const double way = std::fabs(way_m), turn = std::fabs(turn_rad);
    const double measured_way = way_m * model_.travel_scale + n0 * model_.travel_noise_m_per_sqrt_m * std::sqrt(way);
    const double measured_turn = turn_rad * model_.turn_scale + way * model_.drift_rad_per_m +
                                 n1 * model_.turn_noise_rad_per_sqrt_m * std::sqrt(way) +
                                 n2 * model_.turn_noise_rad_per_sqrt_rad * std::sqrt(turn);
    const double turn_variance = model_.turn_noise_rad_per_sqrt_m * model_.turn_noise_rad_per_sqrt_m * way +
                                 model_.turn_noise_rad_per_sqrt_rad * model_.turn_noise_rad_per_sqrt_rad * turn;
    const double way_variance = model_.travel_noise_m_per_sqrt_m * model_.travel_noise_m_per_sqrt_m * way;
    motion_.pose = compose(motion_.pose, small_step(measured_way, measured_turn));
    motion_.covariance[0] += way_variance;
    motion_.covariance[4] += 0.1 * way_variance;
    motion_.covariance[8] += turn_variance;
    pose_ = compose(pose_, small_step(measured_way, measured_turn));
  }

  segloc::PoseEstimate take() { return std::exchange(motion_, {}); }
  const Pose& pose() const { return pose_; }
  void set(const Pose& pose) { pose_ = pose; }

 private:
  OdometryModel model_;
  RandomStream noise_;
  std::uint64_t tick_ = 0;
  segloc::PoseEstimate motion_;
  Pose pose_;
};

// e' P^-1 e for the pose.
double squared_error(const Pose& truth, const segloc::PoseEstimate& estimate) {
  const double e[3] = {estimate.pose.x - truth.x, estimate.pose.y - truth.y,
                       exact::wrap_angle(estimate.pose.heading - truth.heading)};
  double l[3][3] = {}, y[3] = {}, sum = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      double v = estimate.covariance[static_cast<std::size_t>(3 * i + j)];
      for (int k = 0; k < j; ++k) v -= l[i][k] * l[j][k];
      l[i][j] = i == j ? std::sqrt(v) : v / l[j][j];
    }
    double v = e[i];
    for (int k = 0; k < i; ++k) v -= l[i][k] * y[k];
    y[i] = v / l[i][i];
    sum += y[i] * y[i];
  }
  return sum;
}

}  // namespace

Disc Walker::at(double time_s) const {
  const double way = length(to - from);
  const double phase = std::fmod(time_s * speed_m_s, 2.0 * way);
  const double done = phase < way ? phase : 2.0 * way - phase;
  return {from + (done / way) * (to - from), radius_m};
}

TourResult drive(const Room& room, const std::vector<Point>& way, const TourOptions& options) {
  const Point ahead = way[1] - way[0];
  Pose truth{way[0].x, way[0].y, exact::atan2(ahead.y, ahead.x)};
  TourResult result;
  segloc::PoseEstimate start{truth, {}};
  start.covariance[0] = start.covariance[4] = start.covariance[8] = 1e-6;
  result.filter = std::make_unique<segloc::SegmentMapFilter>(options.filter, start);
  Odometer odometer(options.odometry, options.seed);
  odometer.set(truth);
  sick::SegmentExtraction extraction(options.extraction);
  const RandomStream noise(options.seed, "r", "sick.range");
  const auto echoes = std::make_unique<posters::Echoes>();
  const auto segments = std::make_unique<posters::Segments>();
  echoes->mount = options.mount;
  std::vector<Disc> others;

  std::size_t next = 1;
  double error_sum = 0, nees_sum = 0, us_sum = 0;
  while (next < way.size()) {
    for (int step = 0; step < steps_a_scan && next < way.size(); ++step) {
      const Point goal = between(truth, {way[next].x, way[next].y, 0}).position();
      if (length(goal) < 0.15) {
        ++next;
        continue;
      }
      const double bearing = exact::atan2(goal.y, goal.x);
      const double w = std::clamp(2.0 * bearing, -options.turn_rad_s, options.turn_rad_s);
      const double v = std::fabs(bearing) > 0.6 ? 0.0 : options.speed_m_s;
      truth = compose(truth, small_step(v * step_s, w * step_s));
      odometer.move(v * step_s, w * step_s);
      result.way_m += v * step_s;
    }
    if (options.slip_scan > 0 && result.scans == options.slip_scan) truth = compose(truth, options.slip);
    const double time_s = static_cast<double>(result.scans) * steps_a_scan * step_s;
    others.clear();
    for (const Walker& walker : options.walkers) others.push_back(walker.at(time_s));
    room.scan(compose(truth, options.mount), options.laser, noise, result.scans, others, echoes->scan);
    extraction.extract(*echoes, *segments);
    const auto before = std::chrono::steady_clock::now();
    segloc::PoseEstimate motion = odometer.take();
    for (double& variance : motion.covariance) variance *= options.odometry_covariance_scale;
    result.filter->predict(motion);
    const segloc::Observed seen = result.filter->observe(*segments);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;

    const segloc::PoseEstimate estimate = result.filter->position();
    const double error = length(estimate.pose.position() - truth.position());
    result.error_m_max = std::max(result.error_m_max, error);
    result.error_m_end = error;
    result.heading_error_rad_max =
        std::max(result.heading_error_rad_max, std::fabs(exact::wrap_angle(estimate.pose.heading - truth.heading)));
    result.odometry_error_m_end = length(odometer.pose().position() - truth.position());
    result.odometry_error_m_max = std::max(result.odometry_error_m_max, result.odometry_error_m_end);
    result.landmarks_max = std::max(result.landmarks_max, result.filter->landmarks().size());
    error_sum += error;
    nees_sum += squared_error(truth, estimate);
    us_sum += took.count();
    result.observe_us_max = std::max(result.observe_us_max, took.count());
    result.matched_mean += seen.matched;
    result.segments_mean += seen.segments;
    result.used_mean += seen.used;
    result.added += seen.added;
    result.merged += seen.merged;
    result.forgotten += seen.forgotten;
    result.strayed += seen.strayed;
    ++result.scans;
    if (options.after_scan) options.after_scan(time_s, truth, *result.filter);
  }
  const auto scans = static_cast<double>(result.scans);
  result.error_m_mean = error_sum / scans;
  result.nees_mean = nees_sum / scans;
  result.observe_us_mean = us_sum / scans;
  result.matched_mean /= scans;
  result.segments_mean /= scans;
  result.used_mean /= scans;
  result.landmarks_end = result.filter->landmarks().size();
  return result;
}

}  // namespace waitpoint::synthetic
