// SPDX-License-Identifier: BSD-3-Clause
// Programs to be executed: those that the layer's library can be loaded into are simulated.
#pragma once

#include <climits>

namespace waitpoint::posix {

/// The path that execvp() and the like find; the name itself if there is none.
class FoundProgram {
 public:
  explicit FoundProgram(const char* name);
  const char* path() const { return path_; }

 private:
  char found_[PATH_MAX];
  const char* path_;
};

/// False for a program that is statically linked, for another machine, or gains privileges; for a script it is its
/// interpreter that counts. True for files that cannot be executed at all.
bool can_be_simulated(const char* path);

}  // namespace waitpoint::posix
