// SPDX-License-Identifier: BSD-3-Clause
//
// Growth of the filter's map: new landmarks, removal without room, and merging.
#include <cmath>

#include "core/exact_math.hpp"
#include "modules/segloc/segment_map_filter.hpp"

namespace waitpoint::segloc {
// True if a line matched in this scan constrains the pose across the observed line, which can then wait.
bool SegmentMapFilter::held_by_matches(const LineObservation& observation) const {
  for (const std::size_t i : matched_) {
    if (std::fabs(exact::cos(observations_[i].angle_rad - observation.angle_rad)) > 0.7) return true;
  }
  return false;
}

// A new line must be confirmed before it becomes a landmark. Meanwhile other matched lines constrain the pose; if none
// constrains it across this line (the first scan, a room entered at a turn), waiting would put the odometry's drift
// into the map permanently: there a long line becomes a landmark at once, and is removed if it proves unsteady.
void SegmentMapFilter::consider_new(const LineObservation& observation, Observed& result) {
  Landmark landmark;
  if (observation.length_m >= parameters_.length_at_once_m && !held_by_matches(observation)) {
    landmark.line = line_from(pose_, observation);
    landmark.seen.add(
        stretch_between(landmark.line, transform(pose_, observation.start), transform(pose_, observation.end)), 0);
    landmark.sightings = 1;
    landmark.last_update = update_;
  } else if (!candidates_.sight(pose_, observation, update_, landmark)) {
    return;
  }
  if (!make_room(result)) return;
  add(observation, landmark);
  ++result.added;
}

void SegmentMapFilter::forget_unconfirmed(Observed& result) {
  for (std::size_t i = 0; i < landmarks_.size();) {
    const Landmark& landmark = landmarks_[i];
    if (landmark.sightings < parameters_.candidates.sightings_min &&
        landmark.last_update + parameters_.candidates.patience_updates < update_) {
      remove(i);
      ++result.forgotten;
    } else {
      ++i;
    }
  }
}

// Removes the landmark of least worth out of sight if the map is full. The new one may be of less worth: the lines
// around the robot constrain its present pose.
bool SegmentMapFilter::make_room(Observed& result) {
  if (landmarks_.size() < parameters_.landmarks_max) return true;
  std::size_t least = none;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (landmarks_[i].last_update == update_) continue;
    if (least == none || landmarks_[i].worth() < landmarks_[least].worth()) least = i;
  }
  if (least == none) return false;
  remove(least);
  ++result.forgotten;
  return true;
}

// A new line depends on the pose: angle = heading + observed angle; offset = the displacement of the anchor across the
// line by the pose's error; plus the observation's own error.
void SegmentMapFilter::add(const LineObservation& observation, const Landmark& landmark) {
  const std::size_t angle = column_of(landmarks_.size()), offset = angle + 1;
  landmarks_.push_back(landmark);
  const Point n = landmark.line.normal;
  const double lever = turning_lever(pose_, observation.middle, n);
  Covariance& p = covariance_;
  p.append(2);
  for (std::size_t i = 0; i < angle; ++i) {
    p(angle, i) = p(2, i);
    p(offset, i) = n.x * p(0, i) + n.y * p(1, i) + lever * p(2, i);
  }
  const auto [aa, ao, oo] = observation.covariance;
  p(angle, angle) = p(angle, 2) + aa;
  p(offset, angle) = p(offset, 2) + ao;
  p(offset, offset) = n.x * p(offset, 0) + n.y * p(offset, 1) + lever * p(offset, 2) + oo;
}

void SegmentMapFilter::remove(std::size_t landmark) {
  covariance_.remove(column_of(landmark), 2);
  landmarks_[landmark] = landmarks_.back();
  landmarks_.pop_back();
}

std::uint32_t SegmentMapFilter::merge_seen() {
  std::uint32_t merged = 0;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    if (landmarks_[i].last_update != update_) continue;
    for (std::size_t j = 0; j < landmarks_.size();) {
      if (j == i || !try_merge(i, j)) {
        ++j;
        continue;
      }
      // The last landmark has moved into j's place: it is examined next, unless it is i itself.
      ++merged;
      if (i == landmarks_.size()) i = j;
    }
  }
  return merged;
}

// Two landmarks that overlap and agree are one line: an update with their equality, then one is removed.
bool SegmentMapFilter::try_merge(std::size_t kept, std::size_t other) {
  const Line &a = landmarks_[kept].line, &b = landmarks_[other].line;
  const double turn = exact::wrap_angle(b.angle_rad - a.angle_rad);
  if (std::fabs(turn) > parameters_.angle_rad_max || landmarks_[other].seen.stretches().empty()) return false;
  double gap = parameters_.gap_m_max, place = 0;
  for (const auto& s : landmarks_[other].seen.stretches()) {
    const double g = landmarks_[kept].seen.gap_m(stretch_between(a, b.at(s.low_m), b.at(s.high_m)));
    if (g >= gap) continue;
    gap = g;
    place = 0.5 * (s.low_m + s.high_m);
  }
  if (gap > 0) return false;
  const Point common = b.at(place);
  const double beyond = a.beyond(common);
  if (std::fabs(beyond) > parameters_.disputed_offset_m) return false;

  RowPair rows;
  rows.add_column(column_of(other), -1, dot(a.normal, place * b.normal - b.offset_m * b.along()));
  rows.add_column(column_of(other) + 1, 0, -dot(a.normal, b.normal));
  rows.add_column(column_of(kept), 1, -a.place(common));
  rows.add_column(column_of(kept) + 1, 0, 1);
  rows.innovation = {turn, beyond};
  rows.noise = {exact::square(parameters_.angle_floor_rad), 0, exact::square(parameters_.offset_floor_m)};
  joint_.clear(covariance_);
  if (joint_.test(covariance_, rows).squared_distance > parameters_.chi2_merge) return false;
  joint_.accept(covariance_, rows);
  correct();

  Landmark& into = landmarks_[kept];
  const Landmark& from = landmarks_[other];
  for (const auto& s : from.seen.stretches()) {
    into.seen.add(stretch_between(into.line, from.line.at(s.low_m), from.line.at(s.high_m)), parameters_.join_m);
  }
  into.sightings += from.sightings;
  remove(other);
  return true;
}

}  // namespace waitpoint::segloc
