// SPDX-License-Identifier: BSD-3-Clause
// Paths in /proc that name a process or a thread, whose numbers are the simulation's.
#pragma once

#include <climits>

#include "fibers/posix/family/family.hpp"

namespace waitpoint::posix {

/// True for a path in /proc; false for one that cannot be read. A system call.
bool is_in_proc(const char* path);

/// A path in the folder of a process of the family.
struct ProcessPath {
  /// Of "/proc/self/stat", "/proc/1002/stat", "/proc/self/task/1003/stat" and the like; it must be readable.
  explicit ProcessPath(const char* path);

  const family::Process* process = nullptr;  ///< null for other paths
  bool is_own = false;
  bool is_by_number = false;  ///< not by "self"
  const char* rest = "";      ///< "/stat"; empty for the folder itself
};

/// The path as the system knows it.
class PathInSystem {
 public:
  /// `path` may be null, and must live longer.
  explicit PathInSystem(const char* path);
  PathInSystem(const PathInSystem&) = delete;
  PathInSystem& operator=(const PathInSystem&) = delete;
  const char* get() const { return path_; }

 private:
  const char* path_;
  char changed_[PATH_MAX];
};

}  // namespace waitpoint::posix
