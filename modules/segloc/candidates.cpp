// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/candidates.hpp"

#include <cmath>

#include "core/exact_math.hpp"

namespace waitpoint::segloc {

bool Candidates::sight(const Pose& robot, const LineObservation& observation, std::uint64_t update,
                       Landmark& confirmed) {
  const Point start = transform(robot, observation.start), end = transform(robot, observation.end);
  Landmark now;
  now.line = line_from(robot, observation);
  now.seen.add(stretch_between(now.line, start, end), 0);
  now.sightings = 1;
  now.last_update = update;

  for (std::size_t i = 0; i < items_.size(); ++i) {
    Candidate& candidate = items_[i];
    const Landmark& before = candidate.landmark;
    if (before.last_update == update) continue;  // two segments of one scan are different lines
    if (std::fabs(exact::wrap_angle(now.line.angle_rad - before.line.angle_rad)) > parameters_.angle_rad_max) continue;
    if (std::fabs(before.line.beyond(now.line.anchor)) > parameters_.offset_m_max) continue;
    if (before.seen.gap_m(stretch_between(before.line, start, end)) > 0) continue;
    // The newest sighting defines the line; the stretches of earlier ones are kept.
    for (const auto& s : before.seen.stretches()) {
      now.seen.add(stretch_between(now.line, before.line.at(s.low_m), before.line.at(s.high_m)), 0);
    }
    now.sightings = before.sightings + 1;
    candidate.landmark = now;
    const Pose moved = between(candidate.first_seen_from, robot);
    const bool from_elsewhere =
        length(moved.position()) >= parameters_.travel_m_min || std::fabs(moved.heading) >= parameters_.turn_rad_min;
    const bool trusted =
        (from_elsewhere && now.sightings >= parameters_.sightings_min) || now.sightings >= parameters_.sightings_enough;
    if (!trusted) return false;
    confirmed = now;
    remove(i);
    return true;
  }

  if (items_.full()) {
    std::size_t oldest = 0;
    for (std::size_t i = 1; i < items_.size(); ++i) {
      if (items_[i].landmark.last_update < items_[oldest].landmark.last_update) oldest = i;
    }
    remove(oldest);
  }
  items_.push_back({now, robot});
  return false;
}

void Candidates::forget_old(std::uint64_t update) {
  for (std::size_t i = 0; i < items_.size();) {
    if (items_[i].landmark.last_update + parameters_.patience_updates < update) {
      remove(i);
    } else {
      ++i;
    }
  }
}

void Candidates::remove(std::size_t i) {
  items_[i] = items_[items_.size() - 1];
  items_.resize(items_.size() - 1);
}

}  // namespace waitpoint::segloc
