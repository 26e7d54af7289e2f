// SPDX-License-Identifier: BSD-3-Clause
// Tells of a program whose running thread uses the processor and makes no call that is simulated: no other thread gets
// a turn meanwhile. A loop that waits so for another thread never ends; a long computation does.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>

#include "fibers/posix/program/record.hpp"

namespace waitpoint::tools {

class Watchdog {
 public:
  Watchdog(const posix::Record& record, pid_t program) : record_(record), program_(program) {}

  /// To be called now and then: what is to be said, once for each such stretch; mostly nothing.
  std::string look();

 private:
  const posix::Record& record_;
  pid_t program_;
  std::uint64_t events_ = 0;
  double since_s_ = 0;  ///< of the program's processor time, when `events_` were first seen
  bool told_ = false;
};

}  // namespace waitpoint::tools
