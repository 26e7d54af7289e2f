// SPDX-License-Identifier: BSD-3-Clause
// The environment of a program to be executed: it loads the layer's library, and names the family and the entry of the
// process in it.
#pragma once

#include "fibers/posix/traps/processor_counter.hpp"

namespace waitpoint::posix {

namespace family {
struct Process;
}

class StartEnvironment {
 public:
  /// The variables `given`, and those that make the program a part of the simulation as `process`; null: it is native,
  /// and has only those given. It must live until the start.
  StartEnvironment(char* const* given, const family::Process* process);
  ~StartEnvironment();
  StartEnvironment(const StartEnvironment&) = delete;
  StartEnvironment& operator=(const StartEnvironment&) = delete;

  char* const* get() const { return made_ != nullptr ? made_ : given_; }

 private:
  void place_at_random();

  CounterReleased counter_;  ///< before its own library is loaded, the program reads it
  char* const* given_;
  char** made_ = nullptr;
  int persona_ = -1;  ///< of this process, if it has to be restored
};

}  // namespace waitpoint::posix
