// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/temporal_network.hpp"

#include <algorithm>

namespace waitpoint::plan {

TemporalNetwork::TemporalNetwork(std::size_t points) : points_(points), distances_(points * points, unbounded) {
  WAITPOINT_CHECK(points <= points_max, "a temporal network has too many points");
  for (std::size_t i = 0; i < points; ++i) distances_[i * points + i] = Duration();
}

Duration TemporalNetwork::earliest(PointId point) const {
  const Duration back = distance(point, origin);
  return back == unbounded ? -unbounded : -back;
}

bool TemporalNetwork::add(const Edge& edge) {
  WAITPOINT_CHECK(edge.most <= bound_max && edge.most >= -bound_max,
                  "a temporal constraint exceeds the greatest bound");
  const Duration back = distance(edge.to, edge.from);
  if (back != unbounded && back + edge.most < Duration()) {
    explain(edge);
    return false;
  }
  changes_before_.push_back(changes_.size());
  edges_.push_back(edge);
  if (edge.most >= distance(edge.from, edge.to)) return true;
  // A shortest path has the new edge at most once: each pair is tried with it. Its own row and column do not change
  // meanwhile, as no cycle is negative.
  for (PointId i = 0; i < points_; ++i) {
    const Duration before = distance(i, edge.from);
    if (before == unbounded) continue;
    for (PointId j = 0; j < points_; ++j) {
      const Duration after = distance(edge.to, j);
      if (after == unbounded) continue;
      Duration& known = distances_[i * points_ + j];
      const Duration through = before + edge.most + after;
      if (through >= known) continue;
      changes_.push_back({i * points_ + j, known});
      known = through;
    }
  }
  return true;
}

void TemporalNetwork::roll_back(std::size_t mark) {
  WAITPOINT_CHECK(mark <= edges_.size(), "a temporal network is rolled back to a mark of its future");
  const std::size_t kept = mark < edges_.size() ? changes_before_[mark] : changes_.size();
  for (; changes_.size() > kept; changes_.pop_back()) distances_[changes_.back().at] = changes_.back().before;
  edges_.resize(mark);
  changes_before_.resize(mark);
}

// Bellman and Ford's shortest path from the refused edge's end to its beginning: only needed after a conflict.
void TemporalNetwork::explain(const Edge& refused) {
  std::vector<Duration> reached(points_, unbounded);
  std::vector<const Edge*> by(points_, nullptr);
  reached[refused.to] = Duration();
  for (bool changed = true; changed;) {
    changed = false;
    for (const Edge& edge : edges_) {
      if (reached[edge.from] == unbounded || reached[edge.from] + edge.most >= reached[edge.to]) continue;
      reached[edge.to] = reached[edge.from] + edge.most;
      by[edge.to] = &edge;
      changed = true;
    }
  }
  conflict_.clear();
  for (PointId point = refused.from; point != refused.to; point = by[point]->from)
    conflict_.push_back(by[point]->label);
  conflict_.push_back(refused.label);
  std::reverse(conflict_.begin(), conflict_.end());
}

}  // namespace waitpoint::plan
