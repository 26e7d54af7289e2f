// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/point_map.hpp"

#include <algorithm>
#include <cmath>

#include "modules/matching/symmetric_matrix.hpp"

namespace waitpoint::segloc {
namespace {

std::size_t degree_of(Point direction) {
  const double degrees = exact::atan2(direction.y, direction.x) * (180 / exact::pi) + 180;
  return std::min<std::size_t>(static_cast<std::size_t>(degrees), 359);
}

// The nearest point of each degree and its neighbours.
std::array<double, 360> free_space(std::span<const matching::SurfacePoint> scan) {
  std::array<double, 360> own{}, free{};
  for (const matching::SurfacePoint& point : scan) {
    double& range = own[degree_of(point.position)];
    const double seen = length(point.position);
    if (range == 0 || seen < range) range = seen;
  }
  for (std::size_t i = 0; i < 360; ++i) {
    for (const std::size_t k : {(i + 358) % 360, (i + 359) % 360, i, (i + 1) % 360, (i + 2) % 360}) {
      if (own[k] > 0 && (free[i] == 0 || own[k] < free[i])) free[i] = own[k];
    }
  }
  return free;
}

}  // namespace

using matching::Matrix3;

PointMap::PointMap(const PointParameters& parameters, const Pose& start, std::vector<matching::SurfacePoint> known,
                   bool lost)
    : parameters_(parameters), in_active_(start) {
  if (known.empty()) return;
  graph_.add(Pose());
  active_.emplace(Submap{0, 1, empty_map()});
  active_->map.add({}, known);
  keys_.push_back({std::move(known), 0, 0});
  if (lost) adrift_since_ = 1;
}

matching::SurfaceMap PointMap::empty_map() const {
  return matching::SurfaceMap(parameters_.cell_m, parameters_.reach_m, 0.07);
}

Pose PointMap::pose() const { return active_ ? compose(graph_[active_->first], in_active_) : in_active_; }

Matrix3 PointMap::covariance() const {
  const double drift = (keys_.empty() ? 0.02 : std::max(0.02, keys_.back().drift_m)) + (adrift_since_ ? 1 : 0) +
                       std::sqrt(trusted_ ? 0 : open_m2_);
  return matching::diagonal(drift * drift, exact::square(0.01 + 0.05 * drift));
}

// The inverse covariance of a match, whose points do not err independently: with a least deviation.
Matrix3 PointMap::information_of(const Matrix3& match) const {
  Matrix3 weak = match;
  for (double& m : weak) m *= 0.1;
  weak[0] += 1 / exact::square(0.5);
  weak[4] += 1 / exact::square(0.5);
  weak[8] += 1 / exact::square(0.2);
  Matrix3 covariance = matching::inverse(weak);
  covariance[0] += exact::square(parameters_.match_m);
  covariance[4] += exact::square(parameters_.match_m);
  covariance[8] += exact::square(parameters_.match_rad);
  return matching::inverse(covariance);
}

void PointMap::observe(Time date, const Pose& motion, std::span<const matching::SurfacePoint> scan) {
  travel_m_ += length(motion.position());
  if (keys_.empty()) {
    graph_.add(compose(in_active_, motion));
    active_.emplace(Submap{0, 0, empty_map()});
    in_active_ = {};
    add_key(scan);
  } else {
    match(motion, scan);
    if (trusted_ ? key_due() : lost_m_ >= parameters_.lost_m && lost_scans_ > 1) add_key(scan);
  }
  scans_.push_back({date, keys_.size() - 1, between(key_in_active_, in_active_)});
}

void PointMap::match(const Pose& motion, std::span<const matching::SurfacePoint> scan) {
  const double way = length(motion.position()), turn = std::fabs(motion.heading);
  const Pose predicted = compose(in_active_, motion);
  const PointParameters& p = parameters_;
  // Errors of the odometry since the last match.
  open_m2_ += exact::square(p.odometry_m) + exact::square(p.odometry_share * way) + exact::square(0.05 * turn);
  open_rad2_ += exact::square(p.odometry_rad) + exact::square(p.odometry_turn_share * turn) + exact::square(0.03 * way);
  const double deviation_m = std::sqrt(open_m2_), deviation_rad = std::sqrt(open_rad2_);
  const Matrix3 prior = matching::diagonal(1 / open_m2_, 1 / open_rad2_);
  matching::RefinementParameters refinement;
  matching::Refined found = matching::refine(active_->map, scan, predicted, prior, refinement);
  // Where the odometry leaves more than the surroundings of a point open, several poses are tried.
  if (found.explained < parameters_.explained_min || deviation_m > parameters_.reach_m / 4 ||
      deviation_rad > parameters_.reach_m / 4) {
    const auto worth = [&](const matching::Refined& r) {
      const std::array<double, 3> away = {r.pose.x - predicted.x, r.pose.y - predicted.y,
                                          exact::wrap_angle(r.pose.heading - predicted.heading)};
      return parameters_.point_worth * r.fit * static_cast<double>(scan.size()) -
             0.5 * pose_graph::squared_length(away, prior);
    };
    const matching::ScorePyramid pyramid(active_->map, 4);
    matching::SearchParameters search;
    search.score_min = 0.2;
    search.peaks_max = 4;
    search.rival_share = 0.7;
    search.apart_m = 0.15;
    search.apart_rad = 0.1;
    const double half_m = std::min(0.1 + 3 * deviation_m, p.search_m_max);
    for (const matching::Peak& peak :
         matching::search(pyramid, scan, {predicted, half_m, half_m, 0.05 + 3 * deviation_rad}, search)) {
      const matching::Refined other = matching::refine(active_->map, scan, peak.pose, {}, refinement);
      if (worth(other) > worth(found)) found = other;
    }
  }
  explained_ = found.explained;
  trusted_ =
      found.explained >= parameters_.trusted_min && contradicted(found.pose, scan) <= parameters_.contradicted_max;
  in_active_ = trusted_ ? found.pose : predicted;
  if (trusted_) {
    open_m2_ = open_rad2_ = lost_m_ = 0;
    lost_scans_ = 0;
  } else {
    lost_m_ += way;
    if (++lost_scans_ == parameters_.lost_scans && !adrift_since_) adrift_since_ = keys_.size();
  }
  match_information_ = found.information;
}

// The share of a scan's points where the last key scan saw free space: high if the robot is elsewhere, low where it
// enters surroundings that are new.
double PointMap::contradicted(const Pose& robot, std::span<const matching::SurfacePoint> scan) const {
  if (scan.empty()) return 0;
  const Pose from_key = between(key_in_active_, robot);
  std::size_t count = 0;
  for (const matching::SurfacePoint& point : scan) {
    const Point at = transform(from_key, point.position);
    const double free_m = free_m_[degree_of(at)];
    if (length(at) < 0.9 * free_m - 0.2) ++count;
  }
  return static_cast<double>(count) / static_cast<double>(scan.size());
}

bool PointMap::key_due() const {
  const Pose since = between(key_in_active_, in_active_);
  return length(since.position()) >= parameters_.key_travel_m || std::fabs(since.heading) >= parameters_.key_turn_rad;
}

void PointMap::add_key(std::span<const matching::SurfacePoint> scan) {
  const std::size_t key = keys_.size();
  if (key > 0) {
    graph_.add(pose());
    // After a loss nothing holds the next key scan to those before but the odometry, if that.
    if (!trusted_ || adrift_since_ == key) return begin_again(scan);
    // The match is of the active frame's x and y; a measurement is in the frame of the pose measured.
    const Matrix3 information = matching::turned(information_of(match_information_), -in_active_.heading);
    graph_.measure({active_->first, key, in_active_, information, true});
    if (key - 1 != active_->first)
      graph_.measure({key - 1, key, between(key_in_active_, in_active_), information, true});
  }
  const double before = key == 0 ? 0 : keys_.back().drift_m;
  const double way = key == 0 ? 0 : travel_m_ - keys_.back().travel_m;
  keys_.push_back({{scan.begin(), scan.end()}, travel_m_, before + parameters_.drift_m_per_m * way});
  key_in_active_ = in_active_;
  free_m_ = free_space(scan);
  active_->map.add(in_active_, scan);
  if (next_) next_->map.add(between(next_in_active_, in_active_), scan);
  if (++active_->keys == parameters_.submap_keys / 2 && !next_) {
    next_.emplace(Submap{key, 0, empty_map()});
    next_in_active_ = in_active_;
    next_->map.add({}, scan);
  } else if (next_) {
    ++next_->keys;
  }
  if (active_->keys >= parameters_.submap_keys) {
    in_active_ = between(next_in_active_, in_active_);
    key_in_active_ = in_active_;
    active_ = std::move(next_);
    // The half that it has is counted from its first key scan on.
    next_.emplace(Submap{key, 0, empty_map()});
    next_in_active_ = in_active_;
    next_->map.add({}, scan);
  }
  close_loops();
}

// After a loss, or where nothing seen before is in view: a sub-map of its own, held by the odometry alone.
void PointMap::begin_again(std::span<const matching::SurfacePoint> scan) {
  const std::size_t key = keys_.size();
  const double m2 = open_m2_ + exact::square(0.2), rad2 = open_rad2_ + exact::square(0.1);
  graph_.measure({key - 1, key, between(key_in_active_, in_active_), matching::diagonal(1 / m2, 1 / rad2), true});
  keys_.push_back({{scan.begin(), scan.end()}, travel_m_, keys_.back().drift_m + std::sqrt(m2) + 3 * std::sqrt(rad2)});
  active_.emplace(Submap{key, 1, empty_map()});
  next_.reset();
  in_active_ = key_in_active_ = {};
  free_m_ = free_space(scan);
  active_->map.add({}, scan);
  if (!adrift_since_) adrift_since_ = key;
  open_m2_ = open_rad2_ = lost_m_ = 0;
  lost_scans_ = 0;
}

std::vector<posters::StampedPose> PointMap::corrected() const {
  pose_graph::PoseGraph graph = graph_;
  graph.optimise(20);
  std::vector<posters::StampedPose> poses;
  poses.reserve(scans_.size());
  for (const Scan& scan : scans_) poses.push_back({scan.date, compose(graph[scan.key], scan.from_key)});
  return poses;
}

}  // namespace waitpoint::segloc
