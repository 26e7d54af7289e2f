// SPDX-License-Identifier: BSD-3-Clause
// Prints the replay line of a schedule that takes the whole process down: a separate process that only waits for the
// explored one to end, in a session of its own, so that a signal to the process group does not reach it. The data for
// its report is in shared memory, written before each schedule.
//
// It also reports a schedule that takes long, and ends the process, with status 1, if a schedule exceeds the limit or
// waits for something that is not simulated. A body that calls exit() does not end the process with success.
//
//   explored process   ===|schedule 1|===|schedule 2|== killed
//   supervisor             ............................ waits ... prints the replay line of schedule 2
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
  /// Supervises this process, for any `supervision.explored`. Without supervision if no process can be forked, and
  /// under a debugger, which sees the end itself and often causes it.
  explicit Supervisor(Supervision supervision);
  /// Ends the supervision; the explored process continues, and nothing is printed.
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// A run of the default schedule begins.
  void begin_default();
  /// Schedule `number` begins, of the campaign's strategy or, unless null, of another, a literal.
  void begin(std::uint64_t number, const char* strategy = nullptr);
  /// The schedule of the supervised token begins.
  void begin_replay();
  /// That schedule has failed with `failure`; its minimisation begins.
  void begin_minimizing(std::uint64_t number, const char* strategy, const std::string& failure);
  /// The result of `token`'s run in a process forked before the first run; none if it is unknown: without supervision,
  /// or if that process did not finish.
  std::optional<std::uint64_t> outcome_when_fresh(const Token& token);
  /// No schedule is running.
  void pause();

 private:
  void begin(Stage doing);
  static void refuse_exit();
  static Supervisor* latest_;  // for the exit() handler, which has no argument

  Supervised* shared_ = nullptr;
  int pipe_ = -1;
  pid_t explored_ = -1;
  pid_t process_ = -1;
  Supervisor* outer_ = nullptr;  // the supervisor of an enclosing exploration
  struct sigaction before_ {};   // of end_signal
};

}  // namespace waitpoint::exploration
