// SPDX-License-Identifier: BSD-3-Clause
// `waitpoint compare LOG OTHER`: is the log of a simulated robot like that of a real one? Samples of both are compared
// by the test of Kolmogorov and Smirnov.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "modules/genom/module_type.hpp"
#include "tools/command/command_line.hpp"
#include "tools/fit/replayed_log.hpp"
#include "tools/replay/log_options.hpp"

namespace waitpoint::tools {

struct CompareOptions {
  LogOptions first, second;
};

class CompareArguments {
 public:
  explicit CompareArguments(CommandLine& line);
  bool parsed() const { return command_.parsed(); }
  CompareOptions options() const;

 private:
  Command command_;
  LogArguments source_;
  std::string other_;
};

/// Values of one kind, from one log.
struct Sample {
  const char* quantity;  ///< with its unit
  std::vector<double> values;
};

/// What is compared, in the order of the table:
///   the error of the odometry over stretches of 2 m: along the way, and of the heading
///   the time between scans
///   per scan: the number of segments, and their length
///   the distance of each segment's echoes from its line, as a deviation
std::vector<Sample> samples_of(const ReplayedLog& log);

/// A row for each quantity: numbers, medians and deviations of both samples, distance and probability.
std::string comparison_text(const std::vector<Sample>& first, const std::vector<Sample>& second);

/// Prints the table; returns the exit status. BadInput as of a replay.
int compare(const CompareOptions& options, std::span<const genom::ModuleType> types);

}  // namespace waitpoint::tools
