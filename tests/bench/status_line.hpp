// SPDX-License-Identifier: BSD-3-Clause
// The progress of a benchmark on one line, which is written over. Only on a terminal: a file keeps the results alone.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string_view>

namespace waitpoint::bench {

class StatusLine {
 public:
  explicit StatusLine(bool is_terminal, std::FILE* stream = stderr) : stream_(is_terminal ? stream : nullptr) {}
  ~StatusLine() { show(""); }
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// Replaces the line by `text`, of less than a terminal's width; "" removes it.
  void show(std::string_view text);

 private:
  std::FILE* stream_;  // null: not a terminal
  std::size_t shown_ = 0;
};

/// True if the error stream is a terminal.
bool is_terminal();

}  // namespace waitpoint::bench
