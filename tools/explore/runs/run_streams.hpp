// SPDX-License-Identifier: BSD-3-Clause
// The standard streams of a program's runs, one after the other: each reads the same input from its beginning, and
// writes its outputs to memory: to one file, or, which a program seldom notices, to one of each stream.
#pragma once

#include <sys/types.h>

#include <string>

namespace waitpoint::tools {

class RunStreams {
 public:
  /// The input is this process's own if it is a regular file, else empty.
  RunStreams();
  ~RunStreams();
  RunStreams(const RunStreams&) = delete;
  RunStreams& operator=(const RunStreams&) = delete;

  /// For a run in a new process.
  void open(bool has_own_errors = false);
  /// For a run in the process of the last one, which has them open.
  void rewind() const;

  int input() const { return input_; }
  int output() const { return output_; }
  int errors() const { return errors_ >= 0 ? errors_ : output_; }
  /// The last lines that the run has written, indented.
  std::string end_of_output() const;
  /// All that the run has written.
  std::string whole_output() const { return output_from(0); }
  /// True unless standard output is closed.
  static bool are_shown();
  /// What it has written since open() and the last call, to standard output and to its own standard error.
  std::string new_output() { return new_text(output_, shown_); }
  std::string new_errors() { return errors_ >= 0 ? new_text(errors_, errors_shown_) : ""; }

 private:
  static std::string new_text(int file, off_t& shown);
  std::string output_from(off_t from) const;

  int given_, input_ = -1, output_ = -1, errors_ = -1;
  off_t shown_ = 0, errors_shown_ = 0;
};

}  // namespace waitpoint::tools
