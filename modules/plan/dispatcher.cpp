// SPDX-License-Identifier: BSD-3-Clause
#include "modules/plan/dispatcher.hpp"

#include <algorithm>

namespace waitpoint::plan {

Dispatcher::Dispatcher(const Network& network)
    : description_(network), network_(network.points), times_(network.points) {
  times_[origin] = Duration();
  for (const Edge& edge : network.edges)
    if (!add(edge)) return;
  for (const ContingentLink& link : network.links)
    if (!add({link.start, link.end, link.most, link.label}) || !add({link.end, link.start, -link.least, link.label}))
      return;
  controllability_ = plan::controllability(network.points, network.edges, network.links);
  // They follow from a controllable network: none can be refused.
  for (const Edge& edge : controllability_.implied)
    if (edge.most <= bound_max && !add(edge)) return;
}

bool Dispatcher::add(const Edge& edge) {
  if (network_.add(edge)) return true;
  conflict_ = network_.conflict();
  return false;
}

bool Dispatcher::execute(PointId point, Duration time) {
  const std::size_t mark = network_.mark();
  if (!network_.add({origin, point, time, 0}) || !network_.add({point, origin, -time, 0})) {
    network_.roll_back(mark);
    return false;
  }
  times_[point] = time;
  return true;
}

bool Dispatcher::all_executed() const {
  return std::all_of(times_.begin(), times_.end(), [](const auto& time) { return time.has_value(); });
}

// Two points that must be simultaneous are executed in the order of their numbers, nature's first.
bool Dispatcher::precedes(PointId other, PointId point) const {
  const Duration most = network_.distance(point, other);
  if (most > Duration()) return false;
  const bool simultaneous = most == Duration() && network_.distance(other, point) == Duration();
  return !simultaneous || description_.natural[other] || other < point;
}

std::optional<Duration> Dispatcher::ready_at(PointId point) const {
  if (executed(point) || description_.natural[point]) return std::nullopt;
  for (PointId other = 0; other < times_.size(); ++other)
    if (other != point && !executed(other) && precedes(other, point)) return std::nullopt;
  Duration time = std::max(network_.earliest(point), Duration());
  for (const Wait& wait : controllability_.waits) {
    if (wait.point != point) continue;
    const ContingentLink& link = description_.links[wait.link];
    if (executed(link.end)) continue;
    if (!executed(link.start)) return std::nullopt;
    time = std::max(time, *times_[link.start] + wait.after);
  }
  return time;
}

}  // namespace waitpoint::plan
