// SPDX-License-Identifier: BSD-3-Clause
// Programs to be executed: those that the layer's library can be loaded into are simulated.
#pragma once

#include <climits>
#include <cstdint>

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

enum class ProgramKind : std::uint8_t {
  native,  ///< statically linked, for another machine, or gains privileges: it cannot be simulated
  ordinary,
  instrumented,  ///< compiled with -fsanitize=thread
};

/// For a script it is its interpreter that counts. Files that cannot be executed at all are ordinary.
ProgramKind kind_of(const char* path);

}  // namespace waitpoint::posix
