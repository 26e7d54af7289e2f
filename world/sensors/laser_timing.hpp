// SPDX-License-Identifier: BSD-3-Clause
// The times at which a mirror laser measures its beams, and the duration of a scan's transmission.
//
//   turn 1  |0     2     4 ...            |          the field of view is a part of a turn; with two interlaced turns
//   turn 2  |   1     3     5 ...         |          each turn measures every second direction of it
//
// A scan comes over a serial line as one telegram of ten bits a byte: start, address, length (2), command, number of
// ranges (2), two bytes a range, status, checksum (2). At 38 400 bit/s, 361 beams take 191 ms.
#pragma once

#include "world/sensors/types/lasers.hpp"

namespace waitpoint::world {

/// From the first beam of a scan to beam `beam`, in seconds.
double beam_time_s(const LaserDescription& laser, std::uint32_t beam);

/// From the first measured beam of a scan to the last one, in seconds: 0 if all are measured at one instant.
double scan_span_s(const LaserDescription& laser);

std::uint32_t telegram_bytes(const LaserDescription& laser);

/// The shortest period of scans that mirror and line allow; 0 if neither limits it.
Duration least_period(const LaserDescription& laser);

}  // namespace waitpoint::world
