// SPDX-License-Identifier: BSD-3-Clause
// The standard streams of a program's runs, one after the other: each reads the same input from its beginning, and
// writes its outputs to memory.
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
  void open();
  /// For a run in the process of the last one, which has them open.
  void rewind() const;

  int input() const { return input_; }
  int output() const { return output_; }
  /// The last lines that the run has written, indented.
  std::string end_of_output() const;
  /// All that the run has written.
  std::string whole_output() const { return output_from(0); }

 private:
  std::string output_from(off_t from) const;

  int given_, input_ = -1, output_ = -1;
};

}  // namespace waitpoint::tools
