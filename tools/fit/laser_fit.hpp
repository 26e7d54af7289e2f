// SPDX-License-Identifier: BSD-3-Clause
// The errors and the timing of a laser, estimated from its scans.
//
//   resolution   the coarsest of 1 mm, 5 mm, 1 cm, 5 cm and 10 cm of which nearly all ranges are multiples
//   noise        from beams of two scans while the odometry stands still: their differences have twice the variance of
//                a range; that of the rounding is subtracted
//   dropout      beams without an echo in a scan, whose neighbouring scans, standing still, agree on one
//   period       the median time between scans; jitter, the deviation of those times from it, without missing scans
//
// A range bias common to all beams is not observable in a log, and none is estimated.
#pragma once

#include <cstdint>

#include "modules/logs/sensor_log.hpp"

namespace waitpoint::tools {

struct LaserFit {
  std::size_t beams = 0;
  std::size_t stride = 1;  ///< of the log's beams every n-th: more do not fit into a scan of a simulated laser
  double field_of_view_rad = 0;
  double range_max_m = 0;
  double resolution_m = 0;  ///< 0: finer than a millimetre
  double range_noise_m = 0;
  std::uint64_t noise_pairs = 0;  ///< of readings that the noise is from; 0: the robot never stood still
  double dropout = 0;
  double period_s = 0, jitter_s = 0;
  std::uint64_t missing = 0;  ///< scans that did not come
};

/// BadInput for fewer than ten scans, and for scans of a single beam.
LaserFit fit_laser(const logs::SensorLog& log);

}  // namespace waitpoint::tools
