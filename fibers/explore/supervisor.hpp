// SPDX-License-Identifier: BSD-3-Clause
// Sees to it that a schedule which takes the whole process down still says how to repeat it: a process of its own,
// which does nothing but wait for the explored one to end, in a session of its own, so that what kills a whole process
// group does not find it. What it would have to say lies in memory that both share, and is written there before each
// schedule.
//
// It also tells of a schedule that goes on for long, and ends the process, with status 1, where that is too long or the
// schedule waits for something that is not simulated. A body that calls exit() does not end the process as if all were
// well.
//
//   explored process   ===|schedule 1|===|schedule 2|== killed
//   supervisor             ............................ waits ... prints the line that repeats schedule 2
#pragma once

#include <sys/types.h>

#include <csignal>
#include <cstdint>
#include <optional>
#include <string>

#include "fibers/explore/supervised.hpp"

namespace waitpoint::exploration {

class Supervisor {
 public:
  /// Of this process, whatever `supervision` says. Where no process can be had there is no supervision, and none under
  /// a debugger, which sees the end itself and often is the cause of it.
  explicit Supervisor(Supervision supervision);
  /// The explored process goes on: nothing is printed.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// The default schedule begins, maybe again.
  void begin_default();
  /// Schedule `number` begins.
  void begin(std::uint64_t number);
  /// The schedule of the token that is supervised begins.
  void begin_replay();
  /// Schedule `number` has failed, in these words, and is cut down and explained by running others.
  void begin_minimizing(std::uint64_t number, const std::string& failure);
  /// What the run of `token` comes to in a process that was forked before anything was run; nothing where it is not
  /// known: there is no supervision, or the process did not come to the end.
  std::optional<std::uint64_t> outcome_when_fresh(const Token& token);
  /// Nothing of a schedule is under way.
  void pause();

 private:
  void begin(Doing doing);
  static void refuse_exit();
  static Supervisor* latest_;  // for the handler of exit(), which is told nothing

  Supervised* shared_ = nullptr;
  int pipe_ = -1;
  pid_t explored_ = -1;
  pid_t process_ = -1;
  Supervisor* outer_ = nullptr;  // whose body explores in its turn
  struct sigaction before_ {};   // of end_signal
};

}  // namespace waitpoint::exploration
