// SPDX-License-Identifier: BSD-3-Clause
// The memory that a program's run shares with its supervisor: settings and results.
#pragma once

#include "fibers/posix/program/record.hpp"
#include "fibers/posix/reruns/rerun_control.hpp"

namespace waitpoint::tools {

/// Inherited descriptors have numbers from here up: programs that depend on descriptor numbers find the lowest ones
/// free.
inline constexpr int least_descriptor = 900;

/// One at a time per process, mapped at the same address in the program.
class RunMemory {
 public:
  explicit RunMemory(const posix::Settings& settings);
  ~RunMemory();
  /// For another run, after the end of the one before, which may have written anywhere unless it `was_orderly`.
  void begin_anew(const posix::Settings& settings, bool was_orderly);
  posix::RerunControl& rerun_control() const { return posix::rerun_control(); }
  RunMemory(const RunMemory&) = delete;
  RunMemory& operator=(const RunMemory&) = delete;

  posix::Record& record() const { return *record_; }
  /// Of the file that is mapped.
  int descriptor() const { return descriptor_; }

 private:
  void begin(const posix::Settings& settings);
  void discard() const;
  /// Zeroes the memory that the last run has used; false if that is much.
  bool clear() const;

  int descriptor_;
  posix::Record* record_;
};

}  // namespace waitpoint::tools
