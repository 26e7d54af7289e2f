// SPDX-License-Identifier: BSD-3-Clause
// Samples of a log's scans: their segments, and how well each matches the one before.
#pragma once

#include <vector>

#include "tools/fit/replayed_log.hpp"

namespace waitpoint::tools {

struct SegmentSamples {
  std::vector<double> numbers;       ///< of the segments of each scan
  std::vector<double> lengths_m;     ///< of each segment
  std::vector<double> deviations_m;  ///< of the echoes between a segment's ends from its line
};

/// With the default parameters of `sick`.
SegmentSamples segments_of(const logs::SensorLog& log);

struct MatchSamples {
  std::vector<double> deviations_m;  ///< of a scan's echoes from the lines through those of the scan before
  std::vector<double> explained;     ///< share of a scan's echoes within a decimetre of those lines
};

/// Of scans a decimetre, or a tenth of a radian, after each other, so that logs of different periods and times at rest
/// are comparable; matched from the localised poses, by point-to-line matching without a prior.
MatchSamples matches_of(const ReplayedLog& log);

}  // namespace waitpoint::tools
