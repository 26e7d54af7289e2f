// SPDX-License-Identifier: BSD-3-Clause
// A simple temporal network: time points, and constraints `to - from <= most` between them (R. Dechter, I. Meiri,
// J. Pearl, "Temporal constraint networks", Artificial Intelligence 49, 1991), in ticks of a nanosecond.
//
// The network is minimal after each constraint: the distance matrix has the shortest path between each two points, so
// every value within a point's bounds is part of a solution. A constraint costs time quadratic in the number of points.
// A constraint that closes a negative cycle is refused, and the cycle is told. Constraints are taken back exactly, the
// last one first:
//
//   const std::size_t mark = network.mark();
//   if (!network.add({door, end, 5s, 3})) network.roll_back(mark);
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/time.hpp"

namespace waitpoint::plan {

/// A time point of a network, from 0. Point 0 is the origin: the others' times are relative to it.
using PointId = std::uint32_t;
inline constexpr PointId origin = 0;

/// The greatest bound of a constraint, and the greatest number of points: so that no sum on a path overflows.
inline constexpr Duration bound_max = std::chrono::seconds(1'000'000);
inline constexpr std::size_t points_max = 1024;

/// The distance of points that no path of constraints joins.
inline constexpr Duration unbounded = Duration::max();

/// `to - from <= most`; a negative `most` is a least distance in the other direction. `label` names it in conflicts.
struct Edge {
  PointId from, to;
  Duration most;
  std::uint32_t label;
};

class TemporalNetwork {
 public:
  explicit TemporalNetwork(std::size_t points);

  std::size_t points() const { return points_; }
  /// False if the constraint contradicts the others: then it is not added, and conflict() has the cycle.
  bool add(const Edge& edge);
  /// The labels around the negative cycle that the last refused constraint would have closed, beginning with its own.
  const std::vector<std::uint32_t>& conflict() const { return conflict_; }

  /// The least upper bound of `to - from` that follows from the constraints; Duration::max() if there is none.
  Duration distance(PointId from, PointId to) const { return distances_[from * points_ + to]; }
  Duration earliest(PointId point) const;
  Duration latest(PointId point) const { return distance(origin, point); }

  /// The present constraints as a mark for roll_back(), which removes those added since.
  std::size_t mark() const { return edges_.size(); }
  void roll_back(std::size_t mark);

 private:
  struct Change {
    std::size_t at;
    Duration before;
  };
  void explain(const Edge& refused);

  std::size_t points_;
  std::vector<Duration> distances_;  // by from, to
  std::vector<Edge> edges_;
  std::vector<std::size_t> changes_before_;  // by edge
  std::vector<Change> changes_;
  std::vector<std::uint32_t> conflict_;
};

}  // namespace waitpoint::plan
