// SPDX-License-Identifier: BSD-3-Clause
// The memory that a program's run shares with who started it: what it is to do, and what becomes of it.
#pragma once

#include "fibers/posix/program/record.hpp"
#include "tools/exec/program_list.hpp"

namespace waitpoint::tools {

/// From here on descriptors that a program inherits: those that look at the numbers of theirs find the first ones free.
inline constexpr int least_descriptor = 900;

/// There is one at a time in a process, at an address that is the same in the program.
class RunMemory {
 public:
  RunMemory(const posix::Settings& settings, const ProgramList& programs);
  ~RunMemory();
  RunMemory(const RunMemory&) = delete;
  RunMemory& operator=(const RunMemory&) = delete;

  posix::Record& record() const { return *record_; }
  /// Of the file that it is.
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
  posix::Record* record_;
};

}  // namespace waitpoint::tools
