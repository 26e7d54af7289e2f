// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/access_obstacles.hpp"

#include "fibers/posix/reports/race_log.hpp"
#include "tools/exec/family_report.hpp"

namespace waitpoint::tools {

namespace {

const posix::RaceLog* log_of(const posix::Record& record) {
  return static_cast<const posix::RaceLog*>(common_of(record, posix::family::Part::races));
}

}  // namespace

AccessObstacle obstacle_of(const posix::Record& record) {
  const posix::RaceLog* const log = log_of(record);
  return log != nullptr ? log->obstacle : AccessObstacle::none;
}

std::uint64_t watched_libraries_of(const posix::Record& record) {
  const posix::RaceLog* const log = log_of(record);
  return log != nullptr ? log->libraries : 0;
}

std::string words_of(AccessObstacle obstacle) {
  switch (obstacle) {
    case AccessObstacle::none:
    case AccessObstacle::nothing_shared: return "";
    case AccessObstacle::trap_handler: return "the program handles SIGTRAP";
    case AccessObstacle::changed_code: return "the program's code is changed";
    case AccessObstacle::own_code: return "the program accesses its own code";
    case AccessObstacle::allocator: return "the program defines malloc()";
    case AccessObstacle::no_memory: return "there is no memory for breakpoints";
    case AccessObstacle::endless: return "a schedule with breakpoints at accesses did not end";
    case AccessObstacle::unlearned: return "runs that learn its accesses failed";
    case AccessObstacle::several_programs: return "no file of a single program to disassemble";
    case AccessObstacle::several_processes: return "the program has several processes";
    case AccessObstacle::long_loops: return "there are too many";
    case AccessObstacle::no_disassembler: return "built without Zydis";
  }
  return "";
}

}  // namespace waitpoint::tools
