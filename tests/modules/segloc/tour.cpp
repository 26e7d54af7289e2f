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

// The base's report of its motion between two scans: the measured pose in the frame of the last scan, and the
// covariance from its error model.
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

class Tour {
 public:
  Tour(const Room& room, const std::vector<Point>& way, const TourOptions& options)
      : room_(room),
        way_(way),
        options_(options),
        odometer_(options.odometry, options.seed),
        extraction_(options.extraction),
        noise_(options.seed, "r", "sick.range") {
    const Point ahead = way[1] - way[0];
    truth_ = {way[0].x, way[0].y, exact::atan2(ahead.y, ahead.x)};
    odometer_.set(truth_);
    segloc::PoseEstimate start{truth_, {}};
    start.covariance[0] = start.covariance[4] = start.covariance[8] = 1e-6;
    result_.filter = std::make_unique<segloc::SegmentMapFilter>(options.filter, start);
    echoes_->mount = options.mount;
  }

  TourResult drive() {
    while (next_ < way_.size()) {
      go_on();
      if (options_.slip_scan > 0 && result_.scans == options_.slip_scan) truth_ = compose(truth_, options_.slip);
      const double time_s = static_cast<double>(result_.scans) * steps_a_scan * step_s;
      scan(time_s);
      observe();
      compare();
      ++result_.scans;
      if (options_.after_scan) options_.after_scan(time_s, truth_, *result_.filter);
    }
    const auto scans = static_cast<double>(result_.scans);
    for (double TourResult::*mean : {&TourResult::error_m_mean, &TourResult::nees_mean, &TourResult::observe_us_mean,
                                     &TourResult::matched_mean, &TourResult::segments_mean, &TourResult::used_mean})
      result_.*mean /= scans;
    result_.landmarks_end = result_.filter->landmarks().size();
    return std::move(result_);
  }

 private:
  // Along the way points, until the next scan.
  void go_on() {
    for (int step = 0; step < steps_a_scan && next_ < way_.size(); ++step) {
      const Point goal = between(truth_, {way_[next_].x, way_[next_].y, 0}).position();
      if (length(goal) < 0.15) {
        ++next_;
        continue;
      }
      const double bearing = exact::atan2(goal.y, goal.x);
      const double w = std::clamp(2.0 * bearing, -options_.turn_rad_s, options_.turn_rad_s);
      const double v = std::fabs(bearing) > 0.6 ? 0.0 : options_.speed_m_s;
      truth_ = compose(truth_, small_step(v * step_s, w * step_s));
      odometer_.move(v * step_s, w * step_s);
      result_.way_m += v * step_s;
    }
  }

  void scan(double time_s) {
    others_.clear();
    for (const Walker& walker : options_.walkers) others_.push_back(walker.at(time_s));
    room_.scan(compose(truth_, options_.mount), options_.laser, noise_, result_.scans, others_, echoes_->scan);
    extraction_.extract(*echoes_, *segments_);
  }

  void observe() {
    const auto before = std::chrono::steady_clock::now();
    segloc::PoseEstimate motion = odometer_.take();
    for (double& variance : motion.covariance) variance *= options_.odometry_covariance_scale;
    result_.filter->predict(motion);
    const segloc::Observed seen = result_.filter->observe(*segments_);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
    result_.observe_us_mean += took.count();
    result_.observe_us_max = std::max(result_.observe_us_max, took.count());
    result_.matched_mean += seen.matched;
    result_.segments_mean += seen.segments;
    result_.used_mean += seen.used;
    result_.added += seen.added;
    result_.merged += seen.merged;
    result_.forgotten += seen.forgotten;
    result_.strayed += seen.strayed;
  }

  // The estimates of filter and odometry, and the truth.
  void compare() {
    const segloc::PoseEstimate estimate = result_.filter->position();
    const double error = length(estimate.pose.position() - truth_.position());
    result_.error_m_mean += error;
    result_.error_m_max = std::max(result_.error_m_max, error);
    result_.error_m_end = error;
    result_.nees_mean += squared_error(truth_, estimate);
    result_.heading_error_rad_max =
        std::max(result_.heading_error_rad_max, std::fabs(exact::wrap_angle(estimate.pose.heading - truth_.heading)));
    result_.odometry_error_m_end = length(odometer_.pose().position() - truth_.position());
    result_.odometry_error_m_max = std::max(result_.odometry_error_m_max, result_.odometry_error_m_end);
    result_.landmarks_max = std::max(result_.landmarks_max, result_.filter->landmarks().size());
  }

  const Room& room_;
  const std::vector<Point>& way_;
  const TourOptions& options_;
  Pose truth_;
  std::size_t next_ = 1;
  Odometer odometer_;
  sick::SegmentExtraction extraction_;
  RandomStream noise_;
  std::unique_ptr<posters::Echoes> echoes_ = std::make_unique<posters::Echoes>();
  std::unique_ptr<posters::Segments> segments_ = std::make_unique<posters::Segments>();
  std::vector<Disc> others_;
  TourResult result_;  // its means hold sums during the drive
};

}  // namespace

Disc Walker::at(double time_s) const {
  const double way = length(to - from);
  const double phase = std::fmod(time_s * speed_m_s, 2.0 * way);
  const double done = phase < way ? phase : 2.0 * way - phase;
  return {from + (done / way) * (to - from), radius_m};
}

TourResult drive(const Room& room, const std::vector<Point>& way, const TourOptions& options) {
  return Tour(room, way, options).drive();
}

}  // namespace waitpoint::synthetic
