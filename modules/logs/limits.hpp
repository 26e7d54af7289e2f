// SPDX-License-Identifier: BSD-3-Clause
// The greatest magnitudes of numbers in a log of sensors. Numbers beyond them are damage, or have another unit; within
// them, nothing that is computed from a log overflows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/exact_math.hpp"
#include "core/number_text.hpp"

namespace waitpoint::logs {

inline constexpr double position_max_m = 1e6;
inline constexpr double range_max_m = 1e6;
inline constexpr double heading_max_rad = 1e4;    // that of a base may count its turns
inline constexpr double beam_angle_max_rad = 25;  // about four turns

/// "a coordinate within +-1000000". Limits are whole numbers.
inline std::string limited_text(const char* what, double magnitude_max) {
  return std::string(what) + " within +-" + number_text(static_cast<std::int64_t>(magnitude_max));
}

/// The error of a scan of so many beams, so far apart; empty if it spans about a turn at most.
inline std::string span_error(std::size_t beams, double angle_step_rad) {
  constexpr double span_max_rad = 1.1 * 2 * exact::pi;  // beams of some lasers overlap
  const double span_rad = beams > 1 ? angle_step_rad * static_cast<double>(beams - 1) : 0;
  if (span_rad <= span_max_rad && span_rad >= -span_max_rad) return "";
  return "expected the beams of a scan over at most a turn, found " + counted(beams, "beam") + ", one every " +
         number_text(angle_step_rad) + " rad";
}

}  // namespace waitpoint::logs
