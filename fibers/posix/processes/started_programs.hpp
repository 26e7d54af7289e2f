// SPDX-License-Identifier: BSD-3-Clause
// Programs that a simulated one starts: native, unless the run simulates them too (Settings). Then each has a record of
// its own, passed in its environment, and is not watched by `waitpoint exec`.
#pragma once

namespace waitpoint::posix {

/// The environment of a program to be started; must live until then.
class StartEnvironment {
 public:
  /// `given` as it is, or with the variables in front that make the program a simulation.
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
  int persona_ = -1;  ///< of this process, if it has to be restored
};

}  // namespace waitpoint::posix
