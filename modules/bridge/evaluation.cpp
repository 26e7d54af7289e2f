// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/evaluation.hpp"

#include <algorithm>

namespace waitpoint::bridge {
namespace {

constexpr Duration sampling = std::chrono::milliseconds(100);

}  // namespace

void Evaluation::connect(const genom::NameSpace& names) {
  fused_ = dynamic_cast<const genom::Poster<posters::FusedPosition>*>(names.find_poster("pom.position"));
  odometry_ = dynamic_cast<const genom::Poster<posters::Odometry>*>(names.find_poster("rflex.odometry"));
}

void Evaluation::sample(PathKind kind, Time date, const Pose& pose) {
  if (path_sinks_.empty()) return;
  std::optional<Time>& last = sampled_[kind];
  if (last && date - *last < sampling) return;
  last = date;
  for (PathSink* sink : path_sinks_) sink->add(kind, {date, pose});
}

void Evaluation::observe(Time now, const world::BodyState& truth) {
  sample(PathKind::truth, now, truth.pose);
  if (fused_ == nullptr && odometry_ == nullptr) return;  // nothing to compare
  truth_.add(now, truth.pose);
  const auto error_m = [this](const posters::PositionEstimate& estimate) {
    return length(estimate.pose.position() - truth_.at(estimate.date).position());
  };
  if (const auto fused = fused_ != nullptr ? fused_->look() : std::nullopt;
      fused && fused->position.date != fused_date_ && fused->position.date <= now) {
    fused_date_ = fused->position.date;
    const double error = error_m(fused->position);
    ++fused_count_;
    fused_error_sum_m_ += error;
    fused_error_max_m_ = std::max(fused_error_max_m_, error);
    sample(PathKind::estimate, fused_date_, fused->position.pose);
  }
  // Without a localised position there is no common frame for the odometry.
  if (const auto odometry = odometry_ != nullptr ? odometry_->look() : std::nullopt;
      odometry && fused_count_ > 0 && odometry->position.date != odometry_date_) {
    odometry_date_ = odometry->position.date;
    odometry_error_m_ = error_m(odometry->position);
    odometry_error_max_m_ = std::max(odometry_error_max_m_, odometry_error_m_);
    sample(PathKind::odometry, odometry_date_, odometry->position.pose);
  }
}

void Evaluation::add_to(WorkingSet& set) const {
  set.add_between(this, &sampled_);
  if (fused_ != nullptr) fused_->add_to(set);
  if (odometry_ != nullptr) odometry_->add_to(set);
}

void Evaluation::write(RobotResult& result) const {
  result.position_error_mean_m = fused_count_ > 0 ? fused_error_sum_m_ / static_cast<double>(fused_count_) : 0;
  result.position_error_max_m = fused_error_max_m_;
  result.odometry_error_max_m = odometry_error_max_m_;
  result.odometry_error_end_m = odometry_error_m_;
  result.present.position = fused_count_ > 0;
  result.present.odometry = odometry_date_ != Time();
}

}  // namespace waitpoint::bridge
