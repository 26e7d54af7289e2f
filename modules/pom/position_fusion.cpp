// SPDX-License-Identifier: BSD-3-Clause
#include "modules/pom/position_fusion.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace waitpoint::pom {

using posters::greatest_deviation_m;
using posters::operator*;  // NOLINT(misc-unused-using-decls): clang-tidy 14 sees no uses of operators

PositionFusion::PositionFusion(const FusionParameters& parameters, const UncertainPose& start)
    : parameters_(parameters), odometry_(odometry_count_max), base_{Time(), start} {
  on_.fill(true);
}

void PositionFusion::add_odometry(const posters::PositionEstimate& odometry) {
  if (odometry_.empty()) base_.date = std::max(base_.date, odometry.date);
  if (odometry_.full() && odometry.date > odometry_.newest()) forget_before(odometry_.second_oldest());
  const bool in_order = odometry_.empty() || odometry.date > odometry_.newest();
  odometry_.add(odometry.date, {odometry.pose, odometry.covariance});
  // In order, it admits waiting corrections; late, it changes the motion between earlier corrections.
  const auto first = std::find_if(corrections_.begin(), corrections_.end(),
                                  [&](const Correction& c) { return !in_order || !c.applied; });
  if (first != corrections_.end()) apply_from(static_cast<std::size_t>(first - corrections_.begin()));
}

void PositionFusion::add_absolute(std::uint32_t source, const posters::PositionEstimate& position) {
  const UncertainPose measured = {position.pose, position.covariance};
  add({position.date, source, measured, parameters_.gate, false, false, {}});
}

void PositionFusion::add_fix(std::uint32_t source, Time date, const PositionFix& fix, double gate) {
  add({date, source, fix, gate, false, false, {}});
}

void PositionFusion::add(const Correction& added) {
  WAITPOINT_CHECK(added.source < source_count_max, "no such source of positions");
  if (!on_[added.source]) return;
  if (added.date < base_.date) {
    ++late_;
    return;
  }
  const auto key = [](const Correction& c) { return std::tuple(c.date, c.source); };
  const auto place = std::upper_bound(corrections_.begin(), corrections_.end(), added,
                                      [&](const Correction& a, const Correction& b) { return key(a) < key(b); });
  const auto first = place - corrections_.begin();
  corrections_.insert(place, added);
  apply_from(static_cast<std::size_t>(first));
  if (corrections_.size() > correction_count_max) forget_before(corrections_.front().date);
}

UncertainPose PositionFusion::corrected(const UncertainPose& predicted, const UncertainPose& measured) const {
  if (parameters_.kalman)
    return parameters_.shared_errors ? fuse_correlated(predicted, measured) : fuse(predicted, measured);
  return greatest_deviation_m(measured.covariance) <= greatest_deviation_m(predicted.covariance) ? measured : predicted;
}

UncertainPose PositionFusion::corrected(const UncertainPose& predicted, const PositionFix& measured) const {
  if (parameters_.kalman) return fuse(predicted, measured);
  const UncertainPose moved = moved_to(predicted, measured);
  return greatest_deviation_m(moved.covariance) <= greatest_deviation_m(predicted.covariance) ? moved : predicted;
}

void PositionFusion::apply_from(std::size_t first) {
  for (std::size_t i = first; i < corrections_.size(); ++i) {
    Correction& c = corrections_[i];
    c.applied = !odometry_.empty() && c.date <= odometry_.newest();
    if (!c.applied) continue;
    const State& before = i > 0 ? corrections_[i - 1].after : base_;
    const UncertainPose predicted = carry(before, c.date);
    c.after = {c.date, std::visit(
                           [&](const auto& measured) {
                             c.accepted = disagreement(predicted, measured) <= c.gate;
                             return c.accepted ? corrected(predicted, measured) : predicted;
                           },
                           c.measured)};
  }
}

// Merges everything dated up to `date` into the base, which moves to that date.
void PositionFusion::forget_before(Time date) {
  std::size_t gone = 0;
  while (gone < corrections_.size() && corrections_[gone].applied && corrections_[gone].date <= date) {
    const Correction& c = corrections_[gone++];
    base_ = c.after;
    disagrees_in_base_[c.source] = !c.accepted;
    if (c.accepted) base_correction_ = c.date;
  }
  corrections_.erase(corrections_.begin(), corrections_.begin() + static_cast<std::ptrdiff_t>(gone));
  if (date > base_.date) base_ = {date, carry(base_, date)};
}

UncertainPose PositionFusion::carry(const State& from, Time to, Duration horizon) const {
  if (odometry_.empty() || to <= from.date) return from.estimate;
  UncertainPose motion = odometry_.motion(from.date, to, horizon);
  motion.covariance = parameters_.motion_covariance_scale * motion.covariance;
  return compose(from.estimate, motion);
}

const PositionFusion::State& PositionFusion::newest_state() const {
  for (std::size_t i = corrections_.size(); i-- > 0;) {
    if (corrections_[i].applied) return corrections_[i].after;
  }
  return base_;
}

void PositionFusion::set_source(std::uint32_t source, bool on) {
  WAITPOINT_CHECK(source < source_count_max, "no such source of positions");
  on_[source] = on;
}

void PositionFusion::reset(Time date, const UncertainPose& position) {
  std::erase_if(corrections_, [&](const Correction& c) { return c.date <= date; });
  base_ = {date, position};
  base_correction_.reset();
  disagrees_in_base_.fill(false);
  apply_from(0);
}

posters::FusedPosition PositionFusion::at(Time now) const {
  const UncertainPose estimate = carry(newest_state(), now, Duration::from_seconds(parameters_.extrapolation_s_max));
  posters::FusedPosition fused;
  fused.position = {now, estimate.pose, estimate.covariance};
  std::optional<Time> corrected = base_correction_;
  std::array<bool, source_count_max> disagrees = disagrees_in_base_;
  for (const Correction& c : corrections_) {
    if (!c.applied) continue;
    disagrees[c.source] = !c.accepted;
    if (c.accepted) corrected = c.date;
  }
  fused.correction_age = corrected ? now - *corrected : Duration::max();
  const bool uncertain = greatest_deviation_m(estimate.covariance) > parameters_.uncertain_m ||
                         std::sqrt(std::max(0.0, estimate.covariance[8])) > parameters_.uncertain_rad;
  bool disagree = false;
  for (std::size_t source = 0; source < source_count_max; ++source) disagree |= disagrees[source] && on_[source];
  fused.state = disagree    ? posters::FusionState::disagree
                : uncertain ? posters::FusionState::uncertain
                            : posters::FusionState::good;
  return fused;
}

}  // namespace waitpoint::pom
