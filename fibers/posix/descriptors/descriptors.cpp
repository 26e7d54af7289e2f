// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/descriptors/descriptors.hpp"

#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/real_waits.hpp"
#include "fibers/posix/descriptors/connections.hpp"
#include "fibers/posix/descriptors/partners.hpp"
#include "fibers/posix/descriptors/waiters.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/repeatability.hpp"
#include "fibers/posix/program/timer_firing.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

kernel::Object descriptors_object{"descriptor"};
kernel::Object outside_object{"something outside"};

int poll_now(pollfd* descriptors, nfds_t count, int timeout_ms = 0) {
  const int error = errno;
  const int ready = WAITPOINT_NEXT(poll)(descriptors, count, timeout_ms);
  if (ready >= 0) errno = error;
  return ready;
}

// True if the count of a pipe shows that its end is ready; false if only the system knows.
bool is_ready_by_count(const pollfd* descriptors, nfds_t count) {
  if (count != 1) return false;
  if (const InsideFile* const pipe = counted_pipe(descriptors->fd, descriptors->events))
    return is_ready(*pipe, descriptors->events);
  return false;
}

int poll_counted(pollfd* descriptors, nfds_t count) {
  if (!is_ready_by_count(descriptors, count)) return poll_now(descriptors, count);
  descriptors->revents = descriptors->events;
  return 1;
}

// Wakes the threads whose descriptors, or shared objects, are ready, among those that wait for these changes.
bool wake_ready(bool outside_too, family::Changes changes) {
  bool any = false;
  for (Waiter* waiter = first_waiter(); waiter != nullptr; waiter = waiter->next) {
    if (waiter->task->state != kernel::TaskState::blocked || (waiter->outside && !outside_too) ||
        (waiter->awaited & changes) == 0)
      continue;
    const bool is_ready = waiter->is_ready != nullptr ? waiter->is_ready(waiter->what)
                                                      : poll_counted(waiter->descriptors, waiter->count) != 0;
    if (!is_ready) continue;
    // is_ready() may have woken it.
    if (waiter->task->state == kernel::TaskState::blocked) {
      thread_of(*waiter->task).woken_by_timer = is_timer_firing;
      kernel::wake(*waiter->task->scheduler, *waiter->task);
    }
    any = true;
  }
  return any;
}

// As ppoll(), or until a signal comes; a signal that comes before the wait begins is not missed.
void poll_until_a_signal(pollfd* descriptors, nfds_t count, const timespec* longest) {
  const ErrorNumberKept kept;
  const RealWait real;
  sigset_t all, before;
  sigfillset(&all);
  WAITPOINT_NEXT(pthread_sigmask)(SIG_SETMASK, &all, &before);
  if (!has_come_from_outside()) WAITPOINT_NEXT(ppoll)(descriptors, count, longest, &before);
  WAITPOINT_NEXT(pthread_sigmask)(SIG_SETMASK, &before, nullptr);
}

// Waits in real time for any descriptor that a thread waits for.
void wait_really(Duration longest) {
  nfds_t count = 0;
  for (const Waiter* waiter = first_waiter(); waiter != nullptr; waiter = waiter->next) count += waiter->count;
  auto* const all = static_cast<pollfd*>(std::malloc((count + 1) * sizeof(pollfd)));
  if (all == nullptr) refuse("there is no memory to wait for descriptors");
  nfds_t at = 0;
  for (const Waiter* waiter = first_waiter(); waiter != nullptr; waiter = waiter->next) {
    if (waiter->count == 0) continue;
    WAITPOINT_CHECK(waiter->count <= count - at, "the descriptors waited for exceed their number");
    std::memcpy(all + at, waiter->descriptors, waiter->count * sizeof(pollfd));
    at += waiter->count;
  }
  constexpr Duration asking = Duration(std::chrono::milliseconds(20));
  if (anybody_must_ask() && asking < longest) longest = asking;
  const timespec timeout = to_timespec(longest.ns());
  poll_until_a_signal(all, count, longest == Duration::max() ? nullptr : &timeout);
  std::free(all);
}

// Pipes and terminals of others; sockets are known by their addresses.
void note_input_from(int descriptor) {
  struct stat status {};
  constexpr unsigned memory_devices = 1;  // /dev/null and the like
  if (WAITPOINT_NEXT(fstat)(descriptor, &status) != 0) return;
  const bool is_terminal = S_ISCHR(status.st_mode) && major(status.st_rdev) != memory_devices;
  if (!S_ISFIFO(status.st_mode) && !is_terminal) return;
  char source[64];
  std::snprintf(source, sizeof source, "input from outside, from descriptor %d,", descriptor);
  note_unrepeatable(source);
}

}  // namespace

void (*before_look)() = nullptr;
void (*before_partner)() = nullptr;

int wait_for(pollfd* descriptors, nfds_t count, Time deadline, Restart restart) {
  kernel::Task& task = *kernel::running;
  bool outside = false, within_family = true;
  // A host does not look outside at the end of its instants: descriptors are checked when a program acts on one.
  for (nfds_t i = 0; i < count && !has_host; ++i)
    if (descriptors[i].fd >= 0 && !is_inside(descriptors[i].fd)) {
      outside = true;
      within_family = within_family && is_within_family(descriptors[i].fd);
      if (record->settings.strict && (descriptors[i].events & POLLIN) != 0) note_input_from(descriptors[i].fd);
    }
  if (within_family)
    if (const int ready = poll_counted(descriptors, count); ready != 0) return ready;
  for (;;) {
    if (deadline <= task.local_time) return poll_now(descriptors, count);
    kernel::enter(descriptors_object);
    Waiter waiter{&task, descriptors, count, outside, awaited_at(descriptors, count)};
    for (nfds_t i = 0; i < count && outside; ++i)
      waiter.partner = std::max(waiter.partner, partner_at(descriptors[i].fd));
    if (waiter.partner >= Partner::possible && before_partner != nullptr) before_partner();
    add(waiter);
    // While a thread waits outside, the run pauses at the end of each instant.
    if (outside) kernel::pause(*task.scheduler);
    const Wait ended = wait_on(descriptors_object, deadline);
    remove(waiter);
    // Another thread may have taken the data.
    if (const int ready = poll_counted(descriptors, count); ready != 0) return ready;
    if (thread_of(task).in_cancellation_point && is_to_leave(thread_of(task))) return 0;
    if (ended == Wait::interrupted && is_interrupted(restart)) return fail(EINTR);
  }
}

int wait_for(int descriptor, short events, Time deadline, Restart restart) {
  pollfd one{descriptor, events, 0};
  return wait_for(&one, 1, deadline, restart);
}

namespace {

// At the end of the instant the top room looks outside; a host does not.
void pause_to_look() {
  if (!has_host) kernel::pause(*kernel::running->scheduler);
}

}  // namespace

WaitsOutside::WaitsOutside() {
  count_signal_waits(1);
  pause_to_look();
}
WaitsOutside::~WaitsOutside() { count_signal_waits(-1); }

int wait_outside(bool (*is_ready)(const void*), const void* what, Restart restart) {
  kernel::Task& task = *kernel::running;
  while (!is_ready(what)) {
    kernel::enter(outside_object);
    Waiter waiter{&task, nullptr, 0, true, family::of_anything, Partner::none, is_ready, what};
    add(waiter);
    pause_to_look();
    const Wait ended = wait_on(outside_object, Time::max());
    remove(waiter);
    if (thread_of(task).in_cancellation_point && is_to_leave(thread_of(task))) return 0;
    if (ended == Wait::interrupted && !is_ready(what) && is_interrupted(restart)) return fail(EINTR);
  }
  return 1;
}

Wait wait_on_shared(kernel::Object& object, Time deadline, bool (*is_ready)(const void*), const void* what) {
  // Without other processes the thread that changes the object wakes the others; only the last change by a process that
  // has ended may not have been seen.
  if (is_ready(what)) return Wait::came;
  Waiter waiter{kernel::running, nullptr, 0, false, family::of_objects, Partner::none, is_ready, what};
  add(waiter);
  const Wait ended = wait_on(object, deadline);
  remove(waiter);
  return ended;
}

bool wait_for_reader(int descriptor, int patience_ms) {
  WAITPOINT_CHECK(descriptor >= 0, "a reader is waited for at no descriptor");
  pollfd one{descriptor, POLLOUT, 0};
  if (poll_now(&one, 1) > 0) return true;
  // A thread whose descriptors are ready may be the reader.
  for (const Waiter* waiter = first_waiter(); waiter != nullptr; waiter = waiter->next)
    if (waiter->count > 0 && poll_now(waiter->descriptors, waiter->count) > 0) return false;
  // An outside reader that did not read last time is not waited for again.
  if (was_waited_for_in_vain(descriptor)) return false;
  if (poll_now(&one, 1, patience_ms) > 0) return true;
  note_waited_for_in_vain(descriptor);
  return false;
}

void look_at_descriptors(family::Changes changes) {
  if (before_look != nullptr) before_look();
  if (first_waiter() != nullptr) wake_ready(false, changes);
  if ((awaited_outside() & changes) != 0 && family::own != nullptr) family::own->is_to_look = true;
  family::ring(changes);
}

bool wait_outside_for(Duration longest) {
  wait_really(longest);
  return has_come_from_outside() || anybody_waits_outside();
}

void (*note_what_came)() = nullptr;

namespace {

bool look_or_wait(bool may_wait, family::Changes changes) {
  const bool came = take_in_signals_from_outside();
  if (wake_ready(true, changes) || came) return true;
  if (!may_wait) return false;
  if (!anybody_waits_outside()) return false;
  family::note_outside();
  wait_really(Duration::max());
  take_in_signals_from_outside();
  wake_ready(true, family::of_anything);
  return true;
}

}  // namespace

bool look_outside(bool may_wait, family::Changes changes) {
  if ((changes & family::of_connecting) != 0) await_connections();
  const bool came = look_or_wait(may_wait, changes);
  if (came && note_what_came != nullptr) note_what_came();
  return came;
}

}  // namespace waitpoint::posix
