// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/pace.hpp"

#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <ctime>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

pid_t* children = nullptr;
std::size_t child_count = 0, child_room = 0;

// A virtual time, and the real time that corresponds to it.
Time virtual_begin;
std::int64_t real_begin_ns = 0;
bool has_begun = false;

std::int64_t real_ns() {
  timespec now{};
  // By a system call: the C library may read the processor's counter, which may be trapped.
  WAITPOINT_NEXT(syscall)(SYS_clock_gettime, CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

void begin() {
  has_begun = true;
  virtual_begin = kernel::local_time(*kernel::running);
  real_begin_ns = real_ns();
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
  kernel::running->scheduler->enter(next_look.object);
  kernel::running->scheduler->pause();
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
  if (!has_begun) begin();
}

void forget_native_children() {
  child_count = 0;
  has_begun = false;
  if (next_look.event.in_list()) kernel::running->scheduler->cancel(next_look.event);
}

bool is_paced() {
  if (!has_begun) return false;
  const ErrorNumberKept kept;
  while (child_count > 0 && !lives(children[child_count - 1])) --child_count;
  if (child_count == 0) has_begun = false;
  return has_begun;
}

Duration left_until(Time time) {
  WAITPOINT_CHECK(has_begun, "virtual time is compared with real time before both were read");
  const std::int64_t passed_ns = real_ns() - real_begin_ns;
  const std::int64_t left_ns = (time - virtual_begin).ns() - passed_ns;
  return Duration::from_ns(left_ns > 0 ? left_ns : 0);
}

Time look_at_pace(kernel::Scheduler& scheduler, Time next) {
  WAITPOINT_CHECK(has_begun && scheduler.has_entered(next_look.object), "the check for input is not prepared");
  Time now = later(virtual_begin, Duration::from_ns(real_ns() - real_begin_ns));
  if (now < scheduler.global_time()) now = scheduler.global_time();
  if (now >= next) return next;
  if (next_look.event.in_list()) scheduler.cancel(next_look.event);
  scheduler.schedule(next_look.event, now, next_look.object);
  return now;
}

}  // namespace waitpoint::posix
