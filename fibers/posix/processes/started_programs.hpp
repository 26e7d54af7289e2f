// SPDX-License-Identifier: BSD-3-Clause
// Programs that a simulated one starts: native ones, unless the run is to simulate them too (Settings). Then each has a
// record of its own, which it is handed with its environment; nobody watches over it but the system.
#pragma once

namespace waitpoint::posix {

/// What a program is started with; to be kept until it has been.
class StartEnvironment {
 public:
  /// `given` as it is, or with what makes the program a simulation in front.
  explicit StartEnvironment(char* const* given);
  ~StartEnvironment();
  StartEnvironment(const StartEnvironment&) = delete;
  StartEnvironment& operator=(const StartEnvironment&) = delete;

  char* const* get() const { return made_ != nullptr ? made_ : given_; }

 private:
  void place_at_random();

  char* const* given_;
  char** made_ = nullptr;
  int record_ = -1;
  int persona_ = -1;  ///< of this process, if it is to be as it was
};

}  // namespace waitpoint::posix
