// SPDX-License-Identifier: BSD-3-Clause
#include "tools/exec/watchdog.hpp"

#include <fmt/format.h>

#include <ctime>
#include <string>

#include "tools/exec/accounts.hpp"
#include "tools/exec/family_report.hpp"

namespace waitpoint::tools {
namespace {

double processor_s(pid_t process) {
  clockid_t clock{};
  timespec used{};
  if (process <= 0 || clock_getcpuclockid(process, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

}  // namespace

std::string Watchdog::look() {
  if (!record_.began) return "";
  const pid_t process = process_in_turn(record_);
  const std::uint64_t events = events_of(record_);
  const double now_s = processor_s(process);
  if (events != events_ || process != process_ || since_s_ == 0) {
    process_ = process;
    events_ = events;
    since_s_ = now_s;
    reported_ = false;
  }
  if (reported_ || now_s - since_s_ < patience_s_) return "";
  reported_ = true;
  const Computing computing = computing_thread(record_);
  std::string text = computing.thread.empty() ? "a thread" : fmt::format("thread '{}'", computing.thread);
  text += fmt::format(" has computed for {:.0f} s, at {} s of virtual time, without a simulated call", now_s - since_s_,
                      to_string(time_of(record_)));
  if (!computing.place.empty()) text += ", at " + computing.place;
  return text +
         ":\n           if it waits there for another thread or a signal's handler, it waits forever; compiled with\n"
         "           -fsanitize=thread or -fsanitize-coverage=trace-pc the loop ends (docs/exec.md, Loops without "
         "calls)";
}

}  // namespace waitpoint::tools
