// SPDX-License-Identifier: BSD-3-Clause
// The environment of a program to be executed: it loads the layer's library, and names the family and the entry of the
// process in it. An instrumented one loads a library with this project's runtime for -fsanitize=thread, and an empty
// one in place of the compiler's runtime.
#pragma once

#include "fibers/posix/processes/executable.hpp"
#include "fibers/posix/traps/processor_counter.hpp"

namespace waitpoint::posix {

namespace family {
struct Process;
}

/// The kind of a program as it is to be started: where this build has no runtime for instrumented ones, they are
/// native.
ProgramKind kind_to_start(const char* path);

class StartEnvironment {
 public:
  /// The variables `given`, and those that make the program a part of the simulation as `process`; null: it is native,
  /// and has only those given. It must live until the start.
  StartEnvironment(char* const* given, const family::Process* process, ProgramKind kind);
  ~StartEnvironment();
  StartEnvironment(const StartEnvironment&) = delete;
  StartEnvironment& operator=(const StartEnvironment&) = delete;

  char* const* get() const { return made_ != nullptr ? made_ : given_; }

 private:
  void make(const family::Process& process, bool instrumented);
  void place_at_random();

  CounterReleased counter_;  ///< before its own library is loaded, the program reads it
  char* const* given_;
  char** made_ = nullptr;
  int persona_ = -1;  ///< of this process, if it has to be restored
};

}  // namespace waitpoint::posix
