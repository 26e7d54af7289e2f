// SPDX-License-Identifier: BSD-3-Clause
// Reports a run whose running thread uses the processor without a simulated call: no other thread runs meanwhile. A
// loop that spins for another thread, or for a signal's handler, never ends; a long computation does.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

class Watchdog {
 public:
  static constexpr double usual_patience_s = 10;

  /// `patience_s`, of processor time, is the length of a period.
  explicit Watchdog(const posix::Record& record, double patience_s = usual_patience_s)
      : record_(record), patience_s_(patience_s) {}

  /// Call at intervals; returns a message once per such period, otherwise nothing.
  std::string look();

 private:
  const posix::Record& record_;
  double patience_s_;
  pid_t process_ = 0;  ///< of the system, that had the turn when `events_` was first read
  std::uint64_t events_ = 0;
  double since_s_ = 0;  ///< its processor time then
  bool reported_ = false;
};

}  // namespace waitpoint::tools
