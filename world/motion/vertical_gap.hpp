// SPDX-License-Identifier: BSD-3-Clause
// The vertical gap of two upright solids that may climb, over one step.
//
// One is above the other by low - high, negative if they share heights. Both differences are linear in the fraction of
// the step, so the gap, the greater of them, is convex: once it opens it never closes again.
#pragma once

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace waitpoint::world {

/// The heights of a solid at the start of the step; unbounded by default.
struct Heights {
  double low_m = -std::numeric_limits<double>::infinity(), high_m = std::numeric_limits<double>::infinity();
};

class VerticalGap {
 public:
  /// The climbs are those of the whole step.
  VerticalGap(const Heights& a, double a_climb_m, const Heights& b, double b_climb_m)
      : above_m_(a.low_m - b.high_m), below_m_(b.low_m - a.high_m), a_climb_m_(a_climb_m), b_climb_m_(b_climb_m) {
    WAITPOINT_FAST_CHECK(a.low_m <= a.high_m && b.low_m <= b.high_m, "a solid ends below its lower face");
  }

  bool changes() const { return a_climb_m_ != b_climb_m_; }
  double at(double fraction) const { return std::max(above(fraction), below(fraction)); }
  /// The rate at which each one's own climbing closes the gap, in m per step.
  double first_closes_m(double fraction) const { return is_above(fraction) ? -a_climb_m_ : a_climb_m_; }
  double second_closes_m(double fraction) const { return is_above(fraction) ? b_climb_m_ : -b_climb_m_; }
  double closing_m(double fraction) const { return first_closes_m(fraction) + second_closes_m(fraction); }
  /// The time from `fraction`, at which the gap is above `limit_m`, until it reaches the limit; infinite if it never
  /// does.
  double time_to(double limit_m, double fraction) const {
    const double closing = closing_m(fraction);
    return closing > 0 ? (at(fraction) - limit_m) / closing : std::numeric_limits<double>::infinity();
  }

 private:
  double above(double fraction) const { return above_m_ + fraction * (a_climb_m_ - b_climb_m_); }
  double below(double fraction) const { return below_m_ - fraction * (a_climb_m_ - b_climb_m_); }
  bool is_above(double fraction) const { return above(fraction) >= below(fraction); }

  double above_m_, below_m_;
  double a_climb_m_, b_climb_m_;
};

}  // namespace waitpoint::world
