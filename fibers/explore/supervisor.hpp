// SPDX-License-Identifier: BSD-3-Clause
// Sees to it that a schedule which takes the whole process down still says how to repeat it: a process of its own,
// which does nothing but wait for the explored one to end, in a session of its own, so that what kills a whole process
// group does not find it. What it would have to say lies in memory that both share, and is written there before each
// schedule.
//
// It also tells of a schedule that goes on for long, and a body that calls exit() does not end the process as if all
// were well.
//
//   explored process   ===|schedule 1|===|schedule 2|== killed
//   supervisor             ............................ waits ... prints the line that repeats schedule 2
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "fibers/explore/token.hpp"

namespace waitpoint::exploration {

class Supervisor {
 public:
  /// `replay` begins and `after` ends the line that is printed; between them comes the token. Where no process can be
  /// had there is no supervision, and none under a debugger, which sees the end itself and often is the cause of it.
  Supervisor(const Token& token, const std::string& replay, const std::string& after);
  /// The explored process goes on: nothing is printed.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// The default schedule begins.
  void begin_default();
  /// Schedule `number` begins.
  void begin(std::uint64_t number);
  /// Schedule `number` has failed, in these words, and is cut down and explained by running others.
  void begin_minimizing(std::uint64_t number, const std::string& failure);
  /// Nothing of a schedule is under way.
  void pause();

 private:
  struct Shared;
  [[noreturn]] void wait_for_the_end(int pipe, const Token& token, const std::string& replay, const std::string& after);
  void tell_of_long_schedules(int pipe, const Token& token, const std::string& replay, const std::string& after);
  static void refuse_exit();
  static Supervisor* latest_;  // for the handler of exit(), which is told nothing

  Shared* shared_ = nullptr;
  int pipe_ = -1;
  pid_t explored_ = -1;
  pid_t process_ = -1;
  Supervisor* outer_ = nullptr;  // whose body explores in its turn
};

}  // namespace waitpoint::exploration
