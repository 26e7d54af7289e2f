// SPDX-License-Identifier: BSD-3-Clause
// Shows how far a search has come: on a terminal a line redrawn in place; elsewhere a line now and then.
//
// The wall clock is read here, for display and for limits, never by a run.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

#include "tools/output/progress.hpp"

namespace waitpoint::tools {

class SearchProgress {
 public:
  /// The stream is borrowed; whether it is a terminal is the caller's to find out.
  SearchProgress(std::FILE* stream, bool terminal, Progress::Clock clock = &wall_clock_s);

  /// Schedules so far, of which so many are different ones, and so many failed.
  void update(std::uint64_t schedules, std::uint64_t distinct, std::uint64_t failures);
  /// What else is under way, in words.
  void update(const std::string& words);
  /// Takes the line away.
  void finish();
  /// Since the beginning.
  double seconds() const { return clock_() - start_s_; }

 private:
  bool due();
  void show(const std::string& words);

  std::FILE* stream_;
  bool terminal_;
  Progress::Clock clock_;
  double start_s_, next_s_;
  bool shown_ = false;
};

}  // namespace waitpoint::tools
