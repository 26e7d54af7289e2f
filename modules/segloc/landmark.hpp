// SPDX-License-Identifier: BSD-3-Clause
// A line of the map with the history of its sightings: the stretches seen, their number, the last update.
#pragma once

#include <cstdint>

#include "core/fields.hpp"
#include "modules/segloc/line_geometry.hpp"

namespace waitpoint::segloc {

/// Disjoint stretches along a line, in order: a wall without its doors.
class Coverage {
 public:
  struct Stretch {
    double low_m = 0, high_m = 0;
  };

  /// Adds a stretch; joins stretches nearer than `join_m`, and the two nearest ones if there are too many.
  void add(Stretch stretch, double join_m);
  /// Distance of a stretch to the nearest covered one; 0 if they overlap. Infinite without stretches.
  double gap_m(Stretch stretch) const;
  double length_m() const;
  const auto& stretches() const { return stretches_; }

 private:
  void join_nearest();

  Bounded<Stretch, 8> stretches_;
};

struct Landmark {
  Line line;
  Coverage seen;
  std::uint32_t sightings = 0;
  std::uint64_t last_update = 0;  ///< number of the filter's last update that saw it

  /// Priority for keeping it: when there is no room, the landmark of least worth is removed.
  double worth() const { return seen.length_m() * (sightings < 100 ? sightings : 100); }
};

/// The stretch of `line` between the projections of two points.
Coverage::Stretch stretch_between(const Line& line, Point a, Point b);

}  // namespace waitpoint::segloc
