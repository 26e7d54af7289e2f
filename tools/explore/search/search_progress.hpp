// SPDX-License-Identifier: BSD-3-Clause
// Progress of a search: on a terminal, after two seconds, a line redrawn in place; elsewhere none.
//
// Reads the wall clock for display and limits; runs never do.
#pragma once

#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>

#include "fibers/explore/target/progress_listener.hpp"
#include "tools/output/progress.hpp"

namespace waitpoint::tools {

struct SearchNews {
  std::uint64_t schedules = 0, distinct = 0, failures = 0;
  double seconds = 0;      ///< since the beginning
  std::string words = {};  ///< of another activity than searching
};

class SearchProgress final : public exploration::ProgressListener {
 public:
  /// Borrows the stream; the caller determines if it is a terminal.
  SearchProgress(std::FILE* stream, bool terminal, Progress::Clock clock = &wall_clock_s);

  void update(std::uint64_t schedules, std::uint64_t distinct, std::uint64_t failures) override;
  void update(const std::string& words) override;
  /// Calls `heard` with each news, too, at most five times a second.
  void listen(std::function<void(const SearchNews&)> heard) { heard_ = std::move(heard); }
  /// Erases the line.
  void finish() override;
  /// Seconds since construction.
  double seconds() const { return clock_() - start_s_; }

 private:
  bool due();
  void show(const std::string& words);
  void tell();

  std::FILE* stream_;
  bool terminal_;
  Progress::Clock clock_;
  double start_s_, next_s_;
  bool shown_ = false;
  std::function<void(const SearchNews&)> heard_;
  SearchNews news_;
  double next_told_s_ = 0;
};

}  // namespace waitpoint::tools
