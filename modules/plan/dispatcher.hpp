// SPDX-License-Identifier: BSD-3-Clause
// Execution of a temporal network: which points are due, from the times of those executed so far.
//
// A point is ready once all points that must precede it are executed, its waits are over and its earliest time has
// come. Points of nature's, the ends of contingent links, are never ready: they are executed when they are observed. If
// the network is dynamically controllable and each point is executed as soon as it is ready, all constraints hold,
// whatever nature chooses. Of one that is not, the order of execution is the same without that promise.
//
// It knows no clock and no task: all times are relative to the origin, which is executed at 0.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "modules/plan/controllability.hpp"

namespace waitpoint::plan {

/// A network to be executed.
struct Network {
  std::size_t points = 1;
  std::vector<Edge> edges;            ///< without the bounds of the links
  std::vector<ContingentLink> links;  ///< whose ends are ahead
  std::vector<bool> natural;          ///< by point: executed by nature, with a link or without known bounds
};

class Dispatcher {
 public:
  /// Checks consistency, then controllability. See consistent(), which must hold for the calls that follow it.
  explicit Dispatcher(const Network& network);

  bool consistent() const { return conflict_.empty(); }
  /// If it is not consistent: the labels around a negative cycle.
  const std::vector<std::uint32_t>& conflict() const { return conflict_; }
  /// The conflict in it is that of a network that is consistent but not controllable.
  const Controllability& controllability() const { return controllability_; }

  /// False if the constraints do not allow it: then nothing has changed.
  bool execute(PointId point, Duration time);
  bool executed(PointId point) const { return times_[point].has_value(); }
  bool all_executed() const;

  /// The time from which the point is ready if nothing else happens; nothing if it depends on other points.
  std::optional<Duration> ready_at(PointId point) const;
  /// The latest time that the constraints allow; Duration::max() if there is none.
  Duration latest(PointId point) const { return network_.latest(point); }
  /// The earliest.
  Duration earliest(PointId point) const { return network_.earliest(point); }

 private:
  bool add(const Edge& edge);
  bool precedes(PointId other, PointId point) const;

  const Network& description_;
  TemporalNetwork network_;
  Controllability controllability_;
  std::vector<std::uint32_t> conflict_;
  std::vector<std::optional<Duration>> times_;
};

}  // namespace waitpoint::plan
