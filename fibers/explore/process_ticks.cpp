// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/process_ticks.hpp"

#include <ctime>
#include <fstream>
#include <string>

namespace waitpoint::exploration {
namespace {

// By /proc; where it is not mounted, as in a chroot, a process counts as running.
bool is_stopped(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string name;
  std::getline(file, name, ')');  // skips the process id and the name, which may contain blanks
  char state = 0;
  file >> state;
  return state == 'T' || state == 't';
}

}  // namespace

std::optional<std::uint64_t> ticks_of(pid_t process) {
  clockid_t clock{};
  timespec used{};
  if (clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0 || is_stopped(process))
    return std::nullopt;
  return static_cast<std::uint64_t>(used.tv_sec) * ticks_per_s +
         static_cast<std::uint64_t>(used.tv_nsec) / (1'000'000'000 / ticks_per_s);
}

}  // namespace waitpoint::exploration
