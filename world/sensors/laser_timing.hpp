// SPDX-License-Identifier: BSD-3-Clause
// When a mirror laser measures each beam, and how long a scan takes to get out of the device.
//
//   turn 1  |0     2     4 ...            |          the mirror looks at the field of view for part of a turn,
//   turn 2  |   1     3     5 ...         |          and with interlaced turns at every second direction of it
//
// A scan comes over a serial line as one telegram of ten bits a byte: start, address, length (2), command, number of
// ranges (2), two bytes a range, status, checksum (2). At 38 400 bit/s, 361 beams take 191 ms.
#pragma once

#include "world/sensor_description.hpp"

namespace waitpoint::world {

/// From the first beam of a scan to beam `beam`, in seconds.
double beam_time_s(const LaserDescription& laser, std::uint32_t beam);

/// From the first measured beam of a scan to the last one, in seconds: 0 where they are measured at one instant.
double scan_span_s(const LaserDescription& laser);

std::uint32_t telegram_bytes(const LaserDescription& laser);
/// How long the telegram is on the line; 0 without one.
Duration transmission(const LaserDescription& laser);

/// The shortest period at which mirror and line can give scans; 0 where nothing limits it.
Duration least_period(const LaserDescription& laser);

}  // namespace waitpoint::world
