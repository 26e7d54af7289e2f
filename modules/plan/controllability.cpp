// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/controllability.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace waitpoint::plan {
namespace {

constexpr std::size_t no_link = static_cast<std::size_t>(-1);

// In normal form: a link's start is followed, after its least duration, by a point of its own, and the rest of it is
// from 0 to the difference of its bounds:   start -- least --> begin -- 0 to (most - least) --> end
struct NormalEdge {
  PointId from, to;
  Duration most;
  std::size_t lower_of = no_link;          // the lower-case edge of the link: nature may end it at once
  std::vector<std::uint32_t> labels = {};  // of the constraints that it comes from
};

class Propagation {
 public:
  Propagation(std::size_t points, std::span<const Edge> edges, std::span<const ContingentLink> links)
      : points_(points), links_(links), incoming_(points + links.size()), state_(points + links.size()) {
    for (const Edge& edge : edges) add({edge.from, edge.to, edge.most, no_link, {edge.label}});
    for (std::size_t i = 0; i < links.size(); ++i) add_link(i);
  }

  Controllability run() {
    for (PointId point = 0; point < incoming_.size() && result_.controllable; ++point)
      if (is_negative(point)) result_.controllable = propagate_back(point);
    if (!result_.controllable) {
      result_.implied.clear();
      result_.waits.clear();
    }
    return std::move(result_);
  }

 private:
  enum class State : std::uint8_t { ahead, under_way, done };
  struct Level {
    PointId source;
    std::vector<std::uint32_t> labels;  // of the path to it from the next level's source
  };

  void add(NormalEdge edge) { incoming_[edge.to].push_back(std::move(edge)); }

  void add_link(std::size_t i) {
    const ContingentLink& link = links_[i];
    const PointId begin = static_cast<PointId>(points_ + i);
    const Duration spread = link.most - link.least;
    const std::vector<std::uint32_t> labels{link.label};
    add({link.start, begin, link.least, no_link, labels});
    add({begin, link.start, -link.least, no_link, labels});
    add({begin, link.end, spread, no_link, labels});
    add({link.end, begin, Duration(), no_link, labels});
    if (spread == Duration()) return;
    add({begin, link.end, Duration(), i, labels});
    add({link.end, begin, -spread, no_link, labels});  // upper case: nature may take the longest
  }

  bool is_negative(PointId point) const {
    return std::any_of(incoming_[point].begin(), incoming_[point].end(),
                       [](const NormalEdge& edge) { return edge.most < Duration(); });
  }

  bool propagate_back(PointId source);
  void note(PointId from, PointId source, Duration most, const std::vector<std::uint32_t>& labels);
  bool fail(PointId source) {
    const auto first =
        std::find_if(levels_.begin(), levels_.end(), [source](const Level& level) { return level.source == source; });
    for (auto level = first; level != levels_.end(); ++level)
      for (const std::uint32_t label : level->labels)
        if (std::find(result_.conflict.begin(), result_.conflict.end(), label) == result_.conflict.end())
          result_.conflict.push_back(label);
    return false;
  }

  // A point of the normal form, as a point of the network and a distance after it.
  std::pair<PointId, Duration> real(PointId point) const {
    if (point < points_) return {point, Duration()};
    const ContingentLink& link = links_[point - points_];
    return {link.start, link.least};
  }

  std::size_t points_;
  std::span<const ContingentLink> links_;
  std::vector<std::vector<NormalEdge>> incoming_;
  std::vector<State> state_;
  std::vector<Level> levels_;
  Controllability result_;
};

// Morris's DCbackprop: Dijkstra's algorithm backwards along edges that are not negative, after one negative edge.
bool Propagation::propagate_back(PointId source) {
  if (state_[source] == State::under_way) return fail(source);
  if (state_[source] == State::done) return true;
  state_[source] = State::under_way;
  levels_.push_back({source, {}});
  std::vector<Duration> distance(incoming_.size(), unbounded);
  std::vector<std::vector<std::uint32_t>> labels(incoming_.size());  // of the path to the source
  std::vector<bool> visited(incoming_.size());
  std::priority_queue<std::pair<Duration, PointId>, std::vector<std::pair<Duration, PointId>>, std::greater<>> queue;
  const auto reach = [&](const NormalEdge& edge, Duration from_there, const std::vector<std::uint32_t>& rest) {
    const Duration through = edge.most + from_there;
    if (through >= distance[edge.from]) return;
    distance[edge.from] = through;
    labels[edge.from] = edge.labels;
    labels[edge.from].insert(labels[edge.from].end(), rest.begin(), rest.end());
    queue.emplace(through, edge.from);
  };
  for (const NormalEdge& edge : incoming_[source])
    if (edge.most < Duration()) reach(edge, Duration(), {});
  while (!queue.empty()) {
    const auto [here, point] = queue.top();
    queue.pop();
    if (visited[point]) continue;
    visited[point] = true;
    note(point, source, here, labels[point]);
    if (here >= Duration()) {
      add({point, source, here, no_link, labels[point]});
      continue;
    }
    if (is_negative(point)) {
      levels_.back().labels = labels[point];
      if (!propagate_back(point)) return false;
    }
    for (const NormalEdge& edge : incoming_[point])
      // Nature does not end the link at once and, for the same path, take the longest.
      if (edge.most >= Duration() && (edge.lower_of == no_link || source != points_ + edge.lower_of))
        reach(edge, here, labels[point]);
  }
  levels_.pop_back();
  state_[source] = State::done;
  return true;
}

// For the execution. A negative distance to the beginning of the rest of a link is one to its latest end: a wait.
void Propagation::note(PointId from, PointId source, Duration most, const std::vector<std::uint32_t>& labels) {
  const auto [real_from, from_after] = real(from);
  const auto [real_to, to_after] = real(source);
  if (real_from == real_to) return;
  if (source < points_ || most >= Duration()) {
    result_.implied.push_back({real_from, real_to, most + from_after - to_after, labels.front()});
  } else if (from < points_ && from != links_[source - points_].end) {
    result_.waits.push_back({from, source - points_, to_after - most});
    result_.implied.push_back({from, real_to, -to_after, labels.front()});
  }
}

}  // namespace

Controllability controllability(std::size_t points, std::span<const Edge> edges,
                                std::span<const ContingentLink> links) {
  return Propagation(points, edges, links).run();
}

}  // namespace waitpoint::plan
