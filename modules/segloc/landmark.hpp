// SPDX-License-Identifier: BSD-3-Clause
// A line of the map with what is known of it besides its place: which stretches were seen, how often, when last.
#pragma once

#include <cstdint>

#include "core/fields.hpp"
#include "modules/segloc/line_geometry.hpp"

namespace waitpoint::segloc {

/// Stretches along a line, in order, apart from each other: a wall with its doors left open.
class Coverage {
 public:
  struct Stretch {
    double low_m = 0, high_m = 0;
  };

  /// Adds a stretch; those nearer than `join_m` become one, and the two nearest ones where there are too many.
  void add(Stretch stretch, double join_m);
  /// Distance of a stretch to the nearest one covered; 0 where they overlap. Infinite without any.
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
  std::uint64_t last_update = 0;  ///< number of the filter's update that saw it last

  /// Of two landmarks, the one to forget when there is no room: the shorter and less often seen.
  double worth() const { return seen.length_m() * (sightings < 100 ? sightings : 100); }
};

/// The stretch of `line` between two points' feet.
Coverage::Stretch stretch_between(const Line& line, Point a, Point b);

}  // namespace waitpoint::segloc
