// SPDX-License-Identifier: BSD-3-Clause
//
// A timer signals the run's thread twice a second; its handler compares the running task's event with that of the last
// tick. SIGURG, since by default neither a debugger nor a program cares for it. A thread would wait better, but make
// the process one of several threads, which the C library's allocator notices.
#include "tools/run/run_watchdog.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <string>

#include "core/doing.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/task.hpp"
#include "tools/command/interruption.hpp"

namespace waitpoint::tools {
namespace {

constexpr long tick_ns = 500'000'000;
constexpr std::uint64_t patience = 6;  // limits until the end

struct Place {
  std::uint64_t task = 0, event = 0;
  Time time;

  friend bool operator==(const Place&, const Place&) = default;
};

Place last;
std::uint64_t ticks = 0, ticks_max = 0;
char too_long[96], too_long_elsewhere[96], end_of_patience[96];

[[noreturn]] void end(const char* reason, int status) {
  kernel::report_death(reason);
  syscall(SYS_exit_group, status);
  __builtin_unreachable();
}

void tick(int) {
  const int number = errno;
  const kernel::Task* const task = kernel::running;
  const bool is_elsewhere = task == nullptr && Doing::present() != nullptr;
  const Place place = task != nullptr ? Place{task->id, task->sequence, task->local_time}
                      : is_elsewhere  ? Place{0, Doing::count(), Time()}
                                      : Place();
  if ((task == nullptr && !is_elsewhere) || place != last) {
    last = place;
    ticks = 0;
  } else {
    ++ticks;
    if (interruption() != 0)
      end(is_elsewhere ? "the run is interrupted while a module's constructor or destructor runs"
                       : "the run is interrupted while a task does not reach its next event",
          130);
    if (ticks == ticks_max) kernel::report(is_elsewhere ? too_long_elsewhere : too_long);
    if (ticks_max > 0 && ticks == patience * ticks_max) end(end_of_patience, 1);
  }
  errno = number;
}

}  // namespace

bool is_traced() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("TracerPid:")) return line.find_first_of("123456789") != std::string::npos;
  return false;
}

RunWatchdog::RunWatchdog(double limit_s) {
  if (is_traced()) return;
  last = Place();
  ticks = 0;
  ticks_max = static_cast<std::uint64_t>(std::ceil(limit_s * 1e9 / tick_ns));
  std::snprintf(too_long, sizeof too_long, "no event for %g s: a task does not reach its next waitpoint", limit_s);
  std::snprintf(too_long_elsewhere, sizeof too_long_elsewhere, "no event for %g s: a module's code does not return",
                limit_s);
  std::snprintf(end_of_patience, sizeof end_of_patience, "no event for %g s: the run is ended",
                static_cast<double>(patience) * limit_s);
  struct sigaction action {};
  action.sa_handler = tick;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_ONSTACK);
  sigaction(SIGURG, &action, nullptr);
  sigevent event{};
  event.sigev_notify = SIGEV_THREAD_ID;
  event.sigev_signo = SIGURG;
  event._sigev_un._tid = gettid();
  is_armed_ = timer_create(CLOCK_MONOTONIC, &event, &timer_) == 0;
  itimerspec period{};
  period.it_interval.tv_nsec = period.it_value.tv_nsec = tick_ns;
  if (is_armed_) timer_settime(timer_, 0, &period, nullptr);
}

RunWatchdog::~RunWatchdog() {
  if (!is_armed_) return;
  timer_delete(timer_);
  std::signal(SIGURG, SIG_DFL);
}

}  // namespace waitpoint::tools
