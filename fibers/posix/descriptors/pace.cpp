// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/pace.hpp"

#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <ctime>
#include <utility>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/bounded_text.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/partners.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

pid_t* children = nullptr;
std::size_t child_count = 0, child_room = 0;

family::Pace& pace() { return family::family->pace; }

std::int64_t real_ns() {
  timespec now{};
  // By a system call: the C library may read the processor's counter, which may be trapped.
  WAITPOINT_NEXT(syscall)(SYS_clock_gettime, CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

void begin(Time now) { pace() = {true, now, real_ns()}; }

// Of virtual time by real time; native children have their own pace.
double speed() { return child_count > 0 || record->settings.speed <= 0 ? 1 : record->settings.speed; }
std::int64_t passed_ns() {
  return static_cast<std::int64_t>(static_cast<double>(real_ns() - pace().real_begin_ns) * speed());
}

bool lives(pid_t child) {
  siginfo_t information{};
  return WAITPOINT_NEXT(waitid)(P_PID, static_cast<id_t>(child), &information, WEXITED | WNOHANG | WNOWAIT) == 0 &&
         information.si_pid == 0;
}

void look(kernel::EventNode&) { look_outside(false); }

struct Look {
  kernel::EventNode event;
  kernel::Object object{"pace"};
} next_look;

// From now on the run pauses at the end of each instant.
void prepare_to_look() {
  next_look.event.fire = look;
  kernel::enter(next_look.object);
  kernel::pause(*kernel::running->scheduler);
}

}  // namespace

void note_native_child(pid_t child) {
  WAITPOINT_CHECK(child > 0, "a child without an id is noted");
  WAITPOINT_CHECK(child_count <= child_room && (children != nullptr) == (child_room > 0),
                  "the table of children exceeds its memory");
  if (child_count == child_room) {
    const std::size_t room = 2 * child_room + 16;
    auto* const more = static_cast<pid_t*>(std::realloc(children, room * sizeof(pid_t)));
    if (more == nullptr) return;
    children = more;
    child_room = room;
  }
  children[child_count++] = child;
  prepare_to_look();
  if (!pace().has_begun) begin(kernel::local_time(*kernel::running));
}

void forget_native_children() {
  child_count = 0;
  if (next_look.event.in_list()) kernel::cancel(*kernel::running->scheduler, next_look.event);
}

void prepare_to_keep_pace() { prepare_to_look(); }

bool is_paced(const kernel::Scheduler& scheduler) {
  const ErrorNumberKept kept;
  while (child_count > 0 && !lives(children[child_count - 1])) --child_count;
  const bool has_any = has_partner() || anybody_awaits_partner(scheduler);
  family::own->has_partner = child_count > 0 || (record->settings.speed > 0 && has_any);
  const auto needs_pace = [](const family::Process& each) { return family::takes_turns(each) && each.has_partner; };
  const bool is_needed = std::ranges::any_of(family::entries(), needs_pace);
  if (!is_needed)
    pace().has_begun = false;
  else if (!pace().has_begun)
    begin(kernel::global_time(scheduler));
  return is_needed;
}

void report_if_ahead(const kernel::Scheduler& scheduler) {
  static bool is_told = false, waits = false;
  static Time virtual_at;  // the beginning of the wait
  static std::int64_t real_at_ns = 0;
  constexpr double far_s = 10;
  if (is_told || record->settings.asked != nullptr) return;
  const bool waited = std::exchange(waits, anybody_awaits_stream());
  if (!waits) return;
  if (!waited) {
    virtual_at = kernel::global_time(scheduler);
    real_at_ns = real_ns();
    return;
  }
  const std::int64_t ahead_ns = (kernel::global_time(scheduler) - virtual_at).ns() - (real_ns() - real_at_ns);
  const double ahead_s = static_cast<double>(ahead_ns) * 1e-9;
  if (ahead_s < far_s) return;
  is_told = true;
  char line[160];
  BoundedText text(line, sizeof line);
  text.add("waitpoint: virtual time is ahead of real time by %.1f s while a thread waits for input from outside\n",
           ahead_s);
  text.write();
}

Duration left_until(Time time) {
  WAITPOINT_CHECK(pace().has_begun, "virtual time is compared with real time before both were read");
  const std::int64_t left_ns = (time - pace().virtual_begin).ns() - passed_ns();
  return Duration::from_ns(left_ns > 0 ? static_cast<std::int64_t>(static_cast<double>(left_ns) / speed()) : 0);
}

Time look_at_pace(kernel::Scheduler& scheduler, Time next) {
  WAITPOINT_CHECK(pace().has_begun && kernel::has_entered(scheduler, next_look.object),
                  "the check for input is not prepared");
  Time now = later(pace().virtual_begin, Duration::from_ns(passed_ns()));
  if (now < kernel::global_time(scheduler)) now = kernel::global_time(scheduler);
  if (now >= next) return next;
  if (next_look.event.in_list()) kernel::cancel(scheduler, next_look.event);
  kernel::schedule(scheduler, next_look.event, now, next_look.object);
  return now;
}

}  // namespace waitpoint::posix
