// SPDX-License-Identifier: BSD-3-Clause
//
// Loop closure of the map of points, and finding the robot again after a loss.
#include <algorithm>
#include <cmath>

#include "modules/segloc/point_map.hpp"

namespace waitpoint::segloc {
namespace {

constexpr unsigned pyramid_levels = 6;
constexpr std::size_t drawn_max = 6, candidates_max = 3;
constexpr std::uint32_t openings_max = 20000, openings_everywhere_max = 500000;
constexpr double near_m = 2.5;       // old key scans within this of the window are matched with
constexpr double slide_m_max = 0.2;  // between the best pose of the search and its refinement
constexpr double closed_m = 0.1;     // what a closure leaves of the drift

using matching::Matrix3;

}  // namespace

const PointMap::Drawn& PointMap::drawn(std::size_t submap) {
  for (const Drawn& d : drawn_) {
    if (d.submap == submap && d.optimised == optimised_) return d;
  }
  if (drawn_.size() == drawn_max) drawn_.pop_front();
  auto map = std::make_unique<matching::SurfaceMap>(empty_map());
  const std::size_t half = parameters_.submap_keys / 2, middle = submap * half;
  const std::size_t low = middle < half ? 0 : middle - half,
                    high = std::min(middle + half, adrift_since_.value_or(keys_.size()));
  for (std::size_t k = low; k < high; ++k) map->add(between(graph_[middle], graph_[k]), keys_[k].points);
  auto pyramid = std::make_unique<matching::ScorePyramid>(*map, pyramid_levels);
  drawn_.push_back({submap, optimised_, std::move(map), std::move(pyramid)});
  return drawn_.back();
}

// The key scans of old sub-maps near the newest one, the nearest of each sub-map, nearest first.
std::vector<PointMap::Candidate> PointMap::old_ones_nearby() const {
  const std::size_t key = keys_.size() - 1, half = parameters_.submap_keys / 2;
  const std::size_t age = adrift_since_ ? key - *adrift_since_ + 1 : std::size_t{2} * parameters_.submap_keys;
  std::vector<Candidate> candidates;
  if (age > key) return candidates;
  const std::size_t last = key - age;  // the newest old one: the middle of a sub-map is old, too
  for (std::size_t k = 0; k <= last; ++k) {
    const double distance = length(graph_[k].position() - graph_[key].position());
    if (distance > near_m + search_m(k)) continue;
    const std::size_t submap = std::min((k + half / 2) / half, last / half);
    const auto same =
        std::find_if(candidates.begin(), candidates.end(), [&](const auto& c) { return c.submap == submap; });
    if (same == candidates.end()) {
      candidates.push_back({distance, submap, k});
    } else if (distance < same->distance_m) {
      *same = {distance, submap, k};
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.key < b.key;
  });
  if (candidates.size() > candidates_max) candidates.resize(candidates_max);
  return candidates;
}

double PointMap::search_m(std::size_t old) const {
  const double drift = std::max(0.0, keys_.back().drift_m - keys_[old].drift_m);
  return std::clamp(parameters_.search_m_min + 2 * drift, parameters_.search_m_min, parameters_.search_m_max);
}

// The one pose of the newest key scan that a map, drawn in the frame of pose `frame`, explains; none if there is no
// such pose, or a second one.
std::optional<pose_graph::Measurement> PointMap::one_match(const Drawn& drawn, std::size_t frame,
                                                           const matching::SearchWindow& window,
                                                           double explained_min) const {
  const std::size_t key = keys_.size() - 1;
  const auto peaks =
      matching::search(*drawn.pyramid, keys_[key].points, window,
                       {.score_min = parameters_.closure_score_min,
                        .rival_share = parameters_.rival_share,
                        .apart_m = 0.4,
                        .apart_rad = 0.15,
                        .openings_max = whole_ && &drawn == &*whole_ ? openings_everywhere_max : openings_max});
  if (peaks.size() != 1) return std::nullopt;
  const matching::Refined found = matching::refine(*drawn.map, keys_[key].points, peaks[0].pose, {}, {});
  if (found.explained < explained_min) return std::nullopt;
  if (length(found.pose.position() - peaks[0].pose.position()) > slide_m_max) return std::nullopt;
  const Matrix3 information = matching::turned(information_of(found.information), -found.pose.heading);
  return pose_graph::Measurement{frame, key, found.pose, information, true};
}

// A small correction is accepted at once; a large one when a second key scan asks for the same, and then both are.
PointMap::Verdict PointMap::judge(const pose_graph::Measurement& measurement) {
  const Pose here = graph_[measurement.to], should = compose(graph_[measurement.from], measurement.seen);
  const Pose moved = between(here, should);
  if (!adrift_since_ && length(moved.position()) < parameters_.agree_m &&
      std::fabs(moved.heading) < parameters_.agree_rad) {
    accept(measurement);
    return Verdict::small;
  }
  const Pose correction = compose(should, between(here, {}));  // of the frame around the key scan
  bool confirmed = false;
  for (const Closure& w : waiting_) {
    if (w.measurement.to == measurement.to) continue;
    const Pose rest = between(compose(w.correction, here), should);
    if (length(rest.position()) >= parameters_.agree_m || std::fabs(rest.heading) >= parameters_.agree_rad) continue;
    accept(w.measurement);
    confirmed = true;
  }
  if (!confirmed) {
    waiting_.push_back({measurement, correction, travel_m_});
    return Verdict::waiting;
  }
  waiting_.clear();
  accept(measurement);
  if (adrift_since_) move_adrift_by(correction);
  return Verdict::large;
}

// The key scans since a loss go along as a whole: the measurements that join them to those before are the doubtful
// ones.
void PointMap::move_adrift_by(const Pose& correction) {
  for (std::size_t key = *adrift_since_; key < graph_.size(); ++key)
    graph_.place(key, compose(correction, graph_[key]));
}

void PointMap::accept(const pose_graph::Measurement& closure) {
  graph_.measure(closure);
  ++closures_;
  ++closed_since_;
}

void PointMap::close_loops() {
  const std::size_t key = keys_.size() - 1, half = parameters_.submap_keys / 2;
  const Pose before = pose();
  Verdict verdict = Verdict::none;
  const std::vector<Candidate> candidates = old_ones_nearby();
  for (const Candidate& c : candidates) {
    const std::size_t middle = c.submap * half;
    const double half_m = search_m(c.key);
    const double half_rad = std::min(0.3 * half_m, 1.2);
    const auto match =
        one_match(drawn(c.submap), middle, {between(graph_[middle], graph_[key]), half_m, half_m, half_rad},
                  parameters_.closure_explained_min);
    if (!match) continue;
    verdict = std::max(verdict, judge(*match));
    if (verdict >= Verdict::small) keys_[key].drift_m = std::min(keys_[key].drift_m, keys_[c.key].drift_m + closed_m);
    if (verdict == Verdict::large) break;
  }
  // Surroundings that should be known and are not: the error may be greater than assumed.
  if (verdict == Verdict::none && !candidates.empty() && candidates[0].distance_m < 2)
    keys_[key].drift_m += parameters_.doubt_m;
  if (adrift_since_ && verdict != Verdict::large && key % 3 == 0) verdict = std::max(verdict, search_everywhere());
  std::erase_if(waiting_, [&](const Closure& w) { return w.travel_m + 10 < travel_m_; });
  if (verdict == Verdict::large || closed_since_ >= 20) optimise(before);
  if (verdict == Verdict::large) {
    adrift_since_.reset();
    whole_.reset();
  }
}

// After a loss: the whole map from before it, in its own frame.
PointMap::Verdict PointMap::search_everywhere() {
  if (!whole_ || whole_->optimised != optimised_) {
    auto map = std::make_unique<matching::SurfaceMap>(empty_map());
    for (std::size_t k = 0; k < *adrift_since_; ++k) map->add(graph_[k], keys_[k].points);
    auto pyramid = std::make_unique<matching::ScorePyramid>(*map, pyramid_levels + 2);
    whole_.emplace(Drawn{0, optimised_, std::move(map), std::move(pyramid)});
  }
  const matching::SurfaceMap& map = *whole_->map;
  const double half_width = 0.5 * map.width() * map.cell_m(), half_height = 0.5 * map.height() * map.cell_m();
  const Pose centre{map.x() * map.cell_m() + half_width, map.y() * map.cell_m() + half_height, 0};
  auto match = one_match(*whole_, 0, {centre, half_width, half_height, exact::pi}, parameters_.found_explained_min);
  if (!match) return Verdict::none;
  // Measured from the nearest pose of that map rather than from its origin.
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < *adrift_since_; ++k) {
    if (length(graph_[k].position() - match->seen.position()) <
        length(graph_[nearest].position() - match->seen.position()))
      nearest = k;
  }
  const Pose seen = between(graph_[nearest], match->seen);
  match->from = nearest;
  match->seen = seen;
  const Verdict verdict = judge(*match);
  if (verdict == Verdict::large) keys_.back().drift_m = keys_[nearest].drift_m + closed_m;
  return verdict;
}

// A pose that moves with the graph by more than a match's error is told as a jump.
void PointMap::optimise(const Pose& before) {
  graph_.optimise(10);
  ++optimised_;
  closed_since_ = 0;
  const Pose moved = between(before, pose());
  if (length(moved.position()) > parameters_.agree_m || std::fabs(moved.heading) > parameters_.agree_rad) ++jumps_;
}

}  // namespace waitpoint::segloc
