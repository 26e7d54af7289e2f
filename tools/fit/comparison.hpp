// SPDX-License-Identifier: BSD-3-Clause
// Two logs compared, quantity by quantity: the samples, the two-sample tests, and the table of both.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tools/fit/replayed_log.hpp"
#include "tools/fit/two_samples.hpp"

namespace waitpoint::tools {

/// Values of one kind, from one log.
struct Sample {
  const char* quantity;  ///< with its unit
  std::vector<double> values;
};

/// The compared quantities, in the order of the table:
///   the error of the odometry over stretches of 2 m: along the way, and of the heading
///   the time between scans, and its jitter: the differences from their median, without missing scans
///   per scan: the number of segments, and their length
///   the distance of each segment's echoes from its line, as a deviation
///   the distance of a scan's echoes from the scan before, as a deviation, and the share that matches it
std::vector<Sample> samples_of(const ReplayedLog& log);

struct Described {
  std::size_t number = 0;
  double median = 0, deviation = 0;  ///< of no value: 0
};

/// One quantity of both logs.
struct Compared {
  const char* quantity;
  Described first, second;
  std::optional<TwoSamples> test;  ///< none: one of the samples is empty
};

/// The samples of both are of the same quantities.
std::vector<Compared> compared(std::span<const Sample> first, std::span<const Sample> second);

/// A row for each quantity.
std::string comparison_text(std::span<const Compared> rows);
/// {"first": FILE, "second": FILE, "quantities": [...]}
std::string comparison_json(const std::string& first, const std::string& second, std::span<const Compared> rows);

}  // namespace waitpoint::tools
