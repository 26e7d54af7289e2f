// SPDX-License-Identifier: BSD-3-Clause
// A clock as one word of text, for the environment of a process that is to have it: KIND:SCALE:LEAST:GREATEST:BLOCK,
// the kind by its number, the scale in millionths, times in nanoseconds. Without allocation.
#pragma once

#include <cinttypes>
#include <cstddef>
#include <cstdio>

#include "fibers/clocks/clock_options.hpp"

namespace waitpoint::kernel {

/// Room for any clock's text.
inline constexpr std::size_t clock_text_size = 120;

inline void write_clock(const ClockOptions& clock, char (&text)[clock_text_size]) {
  std::snprintf(text, sizeof text, "%u:%" PRId64 ":%" PRId64 ":%" PRId64 ":%" PRId64, static_cast<unsigned>(clock.kind),
                clock.scale_millionths, clock.least.ns(), clock.greatest.ns(), clock.block_cost.ns());
}

/// False, with `clock` unchanged, if the text is no clock's.
inline bool read_clock(const char* text, ClockOptions& clock) {
  unsigned kind = 0;
  std::int64_t scale = 0, least = 0, greatest = 0, block = 0;
  if (std::sscanf(text, "%u:%" SCNd64 ":%" SCNd64 ":%" SCNd64 ":%" SCNd64, &kind, &scale, &least, &greatest, &block) !=
          5 ||
      kind > static_cast<unsigned>(ClockKind::counted))
    return false;
  clock = {static_cast<ClockKind>(kind), scale, Duration::from_ns(least), Duration::from_ns(greatest),
           Duration::from_ns(block)};
  return true;
}

}  // namespace waitpoint::kernel
