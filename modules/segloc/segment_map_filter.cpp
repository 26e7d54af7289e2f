// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/segment_map_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/exact_math.hpp"

namespace waitpoint::segloc {
SegmentMapFilter::SegmentMapFilter(const Parameters& parameters, const PoseEstimate& start)
    : parameters_(parameters),
      pose_(start.pose),
      covariance_(column_of(parameters.landmarks_max)),
      joint_(parameters.matches_max),
      candidates_(parameters.candidates) {
  observations_.reserve(posters::segment_count_max);
  matched_.reserve(posters::segment_count_max);
  unexplained_.reserve(posters::segment_count_max);
  covariance_.append(own_columns);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) covariance_(i, j) = start.covariance[3 * i + j];
  }
  covariance_(3, 3) = exact::square(parameters.travel_scale_deviation);
  covariance_(4, 4) = exact::square(parameters.turn_scale_deviation);
  covariance_(5, 5) = exact::square(parameters.drift_deviation_rad_per_m);
  scans_ = parameters.update_scans;  // so that the first scan is used
}

PoseEstimate SegmentMapFilter::position() const {
  PoseEstimate estimate{pose_, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) estimate.covariance[3 * i + j] = covariance_(i, j);
  }
  return estimate;
}

// pose' = pose (+) corrected motion. With R the rotation by the heading, d pose' = F (d pose, d calibration) + diag(R,
// 1) d motion; per row, F involves at most the heading and one or two of the calibration's variables.
void SegmentMapFilter::predict(const PoseEstimate& motion) {
  const auto [sine, cosine] = exact::sincos(pose_.heading);
  const Pose& measured = motion.pose;
  const Point stretched{cosine * measured.x - sine * measured.y, sine * measured.x + cosine * measured.y};
  const Point moved = (1.0 + calibration_.travel) * stretched;
  const double way = length(measured.position()), turn = std::fabs(measured.heading);
  travel_m_ += way;
  turn_rad_ += turn;

  Covariance& p = covariance_;
  const auto carry = [&](const std::array<double, own_columns>& c) {
    return std::array<double, 3>{c[0] - moved.y * c[2] + stretched.x * c[3], c[1] + moved.x * c[2] + stretched.y * c[3],
                                 c[2] + measured.heading * c[4] + measured.x * c[5]};
  };
  for (std::size_t j = own_columns; j < p.size(); ++j) {
    const auto c = carry({p(j, 0), p(j, 1), p(j, 2), p(j, 3), p(j, 4), p(j, 5)});
    for (std::size_t i = 0; i < 3; ++i) p(j, i) = c[i];
  }
  // F P F' of the first six variables: the rows, then the columns of the result.
  std::array<std::array<double, own_columns>, 3> rows;
  for (std::size_t j = 0; j < own_columns; ++j) {
    const auto c = carry({p(0, j), p(1, j), p(2, j), p(3, j), p(4, j), p(5, j)});
    for (std::size_t i = 0; i < 3; ++i) rows[i][j] = c[i];
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const auto c = carry(rows[i]);
    for (std::size_t j = 0; j <= i; ++j) p(i, j) = c[j];
    for (std::size_t j = 3; j < own_columns; ++j) p(j, i) = rows[i][j];
  }

  const auto& q = motion.covariance;
  const double along = q[0] + exact::square(parameters_.travel_noise_m_per_sqrt_m) * way;
  const double across = q[4] + exact::square(parameters_.travel_noise_m_per_sqrt_m) * way;
  const double c2 = cosine * cosine, s2 = sine * sine, cs = cosine * sine;
  p(0, 0) += c2 * along - 2.0 * cs * q[1] + s2 * across;
  p(1, 0) += cs * (along - across) + (c2 - s2) * q[1];
  p(1, 1) += s2 * along + 2.0 * cs * q[1] + c2 * across;
  p(2, 0) += cosine * q[2] - sine * q[5];
  p(2, 1) += sine * q[2] + cosine * q[5];
  p(2, 2) += q[8] + exact::square(parameters_.drift_noise_rad_per_sqrt_m) * way +
             exact::square(parameters_.turn_noise_rad_per_sqrt_rad) * turn;
  const double turned = (1.0 + calibration_.turn) * measured.heading + calibration_.drift_rad_per_m * measured.x;
  pose_ = {pose_.x + moved.x, pose_.y + moved.y, exact::wrap_angle(pose_.heading + turned)};
}

bool SegmentMapFilter::update_due() {
  ++scans_;
  if (travel_m_ < parameters_.update_travel_m && turn_rad_ < parameters_.update_turn_rad &&
      scans_ < parameters_.update_scans) {
    return false;
  }
  travel_m_ = turn_rad_ = 0;
  scans_ = 0;
  return true;
}

Observed SegmentMapFilter::observe(const posters::Segments& segments) {
  if (!update_due()) {
    Observed passed_over = last_;
    passed_over.used = passed_over.added = passed_over.merged = passed_over.forgotten = 0;
    return passed_over;
  }
  ++update_;
  sort_observations(segments);
  Observed result;
  result.segments = static_cast<std::uint32_t>(observations_.size());
  joint_.clear(covariance_);
  matched_.clear();
  unexplained_.clear();
  for (std::size_t i = 0; i < observations_.size(); ++i) {
    const Match found = match(observations_[i]);
    if (found.landmark != none) {
      matched_.push_back(i);
      if (!joint_.full() && found.information >= parameters_.information_min) {
        joint_.test(covariance_, found.rows);
        joint_.accept(covariance_, found.rows);
        ++result.used;
      }
      note_sighting(landmarks_[found.landmark], observations_[i]);
    } else {
      if (found.strayed) ++result.strayed;
      if (!found.disputed) unexplained_.push_back(i);
    }
  }
  result.matched = static_cast<std::uint32_t>(matched_.size());
  if (!joint_.empty()) correct();
  if (!lost(result)) {
    for (const std::size_t i : unexplained_) consider_new(observations_[i], result);
  }
  candidates_.forget_old(update_);
  forget_unconfirmed(result);
  result.merged = merge_seen();
  last_ = result;
  return result;
}

// Longest first: the most certain matches come first, and later ones are tested jointly with them.
void SegmentMapFilter::sort_observations(const posters::Segments& segments) {
  observations_.clear();
  for (const posters::Segment& segment : segments.items) {
    LineObservation o = line_observation(segment);
    if (o.length_m < parameters_.length_m_min) continue;
    o.covariance[0] += exact::square(parameters_.angle_floor_rad);
    o.covariance[2] += exact::square(parameters_.offset_floor_m);
    observations_.push_back(o);
  }
  std::sort(observations_.begin(), observations_.end(), [](const LineObservation& a, const LineObservation& b) {
    if (a.length_m != b.length_m) return a.length_m > b.length_m;
    return a.angle_rad != b.angle_rad ? a.angle_rad < b.angle_rad : a.middle.x < b.middle.x;
  });
}

RowPair SegmentMapFilter::rows_for(const LineObservation& observation, std::size_t landmark) const {
  const Comparison c = compare(pose_, observation, landmarks_[landmark].line);
  RowPair rows;
  for (std::size_t i = 0; i < 3; ++i) rows.add_column(i, c.by_pose[0][i], c.by_pose[1][i]);
  for (std::size_t i = 0; i < 2; ++i) rows.add_column(column_of(landmark) + i, c.by_line[0][i], c.by_line[1][i]);
  rows.innovation = {c.angle_rad, c.offset_m};
  rows.noise = observation.covariance;
  return rows;
}

SegmentMapFilter::Match SegmentMapFilter::match(const LineObservation& observation) {
  const Point start = transform(pose_, observation.start), end = transform(pose_, observation.end);
  const Point middle = 0.5 * (start + end);
  const double angle = observation.angle_rad + pose_.heading;
  Match found;
  double best_distance = parameters_.chi2_match;
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Landmark& landmark = landmarks_[i];
    const double beyond = landmark.line.beyond(middle);
    if (std::fabs(beyond) > parameters_.offset_m_max) continue;
    if (std::fabs(exact::wrap_angle(angle - landmark.line.angle_rad)) > parameters_.angle_rad_max) continue;
    const double gap = landmark.seen.gap_m(stretch_between(landmark.line, start, end));
    if (gap > parameters_.gap_m_max) continue;
    const RowPair rows = rows_for(observation, i);
    const JointUpdate::Trial trial = joint_.test(covariance_, rows);
    if (trial.squared_distance < best_distance) {
      best_distance = trial.squared_distance;
      found.landmark = i;
      found.rows = rows;
      found.information = trial.information;
    } else if (gap <= parameters_.join_m) {
      found.strayed = true;
      if (std::fabs(beyond) < parameters_.disputed_offset_m) found.disputed = true;
    }
  }
  return found;
}

void SegmentMapFilter::note_sighting(Landmark& landmark, const LineObservation& observation) {
  const Point start = transform(pose_, observation.start), end = transform(pose_, observation.end);
  landmark.seen.add(stretch_between(landmark.line, start, end), parameters_.join_m);
  if (landmark.last_update != update_) ++landmark.sightings;
  landmark.last_update = update_;
}

void SegmentMapFilter::correct() {
  pose_.x += joint_.correction(0);
  pose_.y += joint_.correction(1);
  pose_.heading = exact::wrap_angle(pose_.heading + joint_.correction(2));
  calibration_.travel += joint_.correction(3);
  calibration_.turn += joint_.correction(4);
  calibration_.drift_rad_per_m += joint_.correction(5);
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    Line& line = landmarks_[i].line;
    line.turn_to(line.angle_rad + joint_.correction(column_of(i)));
    line.offset_m += joint_.correction(column_of(i) + 1);
  }
  joint_.apply(covariance_);
}

// True if mismatches are due to the pose, so that nothing should be added. If they persist, the uncertainty of the pose
// is increased until segments match again; if that does not help, they are accepted as new lines.
bool SegmentMapFilter::lost(const Observed& result) {
  lost_ = result.strayed > result.matched + 1 ? lost_ + 1 : 0;
  if (lost_ == 0 || lost_ > parameters_.lost_updates_max) return false;
  if (lost_ >= parameters_.lost_updates) {
    covariance_(0, 0) += exact::square(parameters_.lost_noise_m);
    covariance_(1, 1) += exact::square(parameters_.lost_noise_m);
    covariance_(2, 2) += exact::square(parameters_.lost_noise_rad);
  }
  return true;
}

void SegmentMapFilter::export_map(posters::SegmentMap& map) const {
  map.items.clear();
  for (const Landmark& landmark : landmarks_) {
    for (const auto& s : landmark.seen.stretches()) {
      if (map.items.full()) return;
      map.items.push_back({landmark.line.at(s.low_m), landmark.line.at(s.high_m)});
    }
  }
}

}  // namespace waitpoint::segloc
