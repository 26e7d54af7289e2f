// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/segment_map_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/exact_math.hpp"

namespace waitpoint::segloc {
namespace {

double square(double x) { return x * x; }

}  // namespace

SegmentMapFilter::SegmentMapFilter(const Parameters& parameters, const PoseEstimate& start)
    : parameters_(parameters),
      pose_(start.pose),
      covariance_(3 + 2 * parameters.landmarks_max),
      joint_(parameters.matches_max, covariance_.stride()),
      candidates_(parameters.candidates) {
  WAITPOINT_CHECK(parameters.matches_max > 0 && parameters.landmarks_max > 0, "a filter without room for lines");
  landmarks_.reserve(parameters.landmarks_max);
  observations_.reserve(posters::segment_count_max);
  matched_.reserve(posters::segment_count_max);
  unexplained_.reserve(posters::segment_count_max);
  covariance_.append(3);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j <= i; ++j) covariance_(i, j) = start.covariance[3 * i + j];
  }
  scans_ = parameters.update_scans;  // the first scan is taken in
}

PoseEstimate SegmentMapFilter::position() const {
  PoseEstimate estimate{pose_, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) estimate.covariance[3 * i + j] = covariance_(i, j);
  }
  return estimate;
}

// pose' = pose (+) motion: with R the turn by the heading, d pose' = F d pose + diag(R, 1) d motion.
void SegmentMapFilter::predict(const PoseEstimate& motion) {
  const auto [sine, cosine] = exact::sincos(pose_.heading);
  const double dx = cosine * motion.pose.x - sine * motion.pose.y, dy = sine * motion.pose.x + cosine * motion.pose.y;
  const double way = length(motion.pose.position()), turn = std::fabs(motion.pose.heading);
  travel_m_ += way;
  turn_rad_ += turn;

  // The systematic errors of the odometry, as noise along the way and in the heading.
  auto q = motion.covariance;
  const double travel = square(parameters_.travel_noise_m_per_sqrt_m) * way;
  q[0] += travel;
  q[4] += travel;
  q[8] += square(parameters_.drift_noise_rad_per_sqrt_m) * way + square(parameters_.turn_noise_rad_per_sqrt_rad) * turn;

  Covariance& p = covariance_;
  for (std::size_t i = 3; i < p.size(); ++i) {
    p(i, 0) -= dy * p(i, 2);
    p(i, 1) += dx * p(i, 2);
  }
  const double p00 = p(0, 0), p10 = p(1, 0), p11 = p(1, 1), p20 = p(2, 0), p21 = p(2, 1), p22 = p(2, 2);
  const double c2 = cosine * cosine, s2 = sine * sine, cs = cosine * sine;
  p(0, 0) = p00 - 2.0 * dy * p20 + dy * dy * p22 + (c2 * q[0] - 2.0 * cs * q[1] + s2 * q[4]);
  p(1, 0) = p10 + dx * p20 - dy * p21 - dx * dy * p22 + (cs * (q[0] - q[4]) + (c2 - s2) * q[1]);
  p(1, 1) = p11 + 2.0 * dx * p21 + dx * dx * p22 + (s2 * q[0] + 2.0 * cs * q[1] + c2 * q[4]);
  p(2, 0) = p20 - dy * p22 + (cosine * q[2] - sine * q[5]);
  p(2, 1) = p21 + dx * p22 + (sine * q[2] + cosine * q[5]);
  p(2, 2) = p22 + q[8];
  pose_ = compose(pose_, motion.pose);
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
  joint_.clear();
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

// Longest first: the surest matches come first and the others are tested jointly with them.
void SegmentMapFilter::sort_observations(const posters::Segments& segments) {
  observations_.clear();
  for (const posters::Segment& segment : segments.items) {
    LineObservation o = line_observation(segment);
    if (o.length_m < parameters_.length_m_min) continue;
    o.covariance[0] += square(parameters_.angle_floor_rad);
    o.covariance[2] += square(parameters_.offset_floor_m);
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
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    Line& line = landmarks_[i].line;
    line.turn_to(line.angle_rad + joint_.correction(column_of(i)));
    line.offset_m += joint_.correction(column_of(i) + 1);
  }
  joint_.apply(covariance_);
}

// Whether what does not match is the pose's fault, so that nothing should be learnt. When it goes on, the pose is made
// less sure until the segments match again; when that does not help, they are taken for what they look like: new.
bool SegmentMapFilter::lost(const Observed& result) {
  lost_ = result.strayed > result.matched ? lost_ + 1 : 0;
  if (lost_ == 0 || lost_ > parameters_.lost_updates_max) return false;
  if (lost_ >= parameters_.lost_updates) {
    covariance_(0, 0) += square(parameters_.lost_noise_m);
    covariance_(1, 1) += square(parameters_.lost_noise_m);
    covariance_(2, 2) += square(parameters_.lost_noise_rad);
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
