// SPDX-License-Identifier: BSD-3-Clause
// Reports a program whose running thread uses the processor without a simulated call: no other thread runs meanwhile. A
// loop that spins for another thread never ends; a long computation does.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

class Watchdog {
 public:
  Watchdog(const posix::Record& record, pid_t program) : record_(record), program_(program) {}

  /// Call at intervals; returns a message once per such period, otherwise nothing.
  std::string look();

 private:
  const posix::Record& record_;
  pid_t program_;
  std::uint64_t events_ = 0;
  double since_s_ = 0;  ///< processor time of the program when `events_` was first read
  bool told_ = false;
};

}  // namespace waitpoint::tools
