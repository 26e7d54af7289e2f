// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/exec/idle_watch.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/watch.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/order.hpp"
#include "fibers/posix/family/processes.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/timer_firing.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

using family::Idleness;
using family::Process;

constexpr std::uint64_t events_least = 1000;
constexpr Duration timers_only_at_most = Duration(std::chrono::seconds(1000));

struct Observer : kernel::Watch {
  kernel::Watch* next = nullptr;  // the run's own, if it has one
};
Observer observer;
bool observes = false;
Time check_at;  // if it does not observe, it begins then
Time observes_since;
std::uint64_t fired_before = 0;

Duration limit() { return record->settings.idle_limit; }
Duration unobserved() { return Duration::from_ns(limit().ns() / 8); }
Duration between_checks() { return std::min(unobserved(), Duration::from_ns(timers_only_at_most.ns() / 8)); }
Idleness& idleness() { return family::family->idleness; }

void note_wake_up(kernel::Scheduler& scheduler, Time now) {
  idleness() = {.woken_at = now, .acted_at = now};
  if (std::exchange(observes, false)) kernel::set_watch(scheduler, observer.next);
  check_at = later(now, unobserved());
}

// Loops that poll a flag meet at its lock.
bool is_lock(const kernel::Object* object) {
  return object != nullptr &&
         (std::strcmp(object->kind, "mutex") == 0 || std::strcmp(object->kind, "read-write lock") == 0);
}

void observe(kernel::Watch&, const kernel::EventRecord& event) {
  if (observer.next != nullptr) observer.next->event(*observer.next, event);
  ++idleness().events;
  idleness().acted_at = event.time;
  if (event.operation != kernel::Operation::resume || !is_thread(*event.task)) return;
  if (!std::exchange(thread_of(*event.task).woken_by_timer, false) && !is_lock(event.object))
    note_wake_up(*event.task->scheduler, event.time);
}

// The bytes that a process has written so far, by the system's count: the C library's output is no call that could be
// noticed. 0 if unknown.
std::uint64_t written_by(const Process& process) {
  char path[40], text[512];
  std::snprintf(path, sizeof path, "/proc/%d/io", static_cast<int>(process.real_id.load()));
  const int file = WAITPOINT_NEXT(open)(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return 0;
  const ssize_t size = WAITPOINT_NEXT(read)(file, text, sizeof text - 1);
  WAITPOINT_NEXT(close)(file);
  text[size > 0 ? size : 0] = '\0';
  const char* const found = std::strstr(text, "wchar: ");
  return found != nullptr ? std::strtoull(found + 7, nullptr, 10) - process.written_by_timers : 0;
}

bool has_written() {
  bool any = false;
  for (Process& process : family::entries()) {
    if (!family::takes_turns(process)) continue;
    const std::uint64_t written = written_by(process);
    any = any || written != process.written;
    process.written = written;
  }
  return any;
}

// A partner outside may act at any time; a native program's acts are not seen.
bool anybody_outside() {
  return std::ranges::any_of(family::entries(), [](const Process& process) {
    return process.state == Process::State::alive && (process.is_native || process.awaits_input);
  });
}

// True if only a timer could let a thread continue.
bool can_nobody_continue(const kernel::Scheduler& scheduler) {
  if (family::least_of_others().time != Time::max()) return false;
  for (const kernel::Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next)
    if (task->state != kernel::TaskState::blocked || task->finite_wait) return false;
  return true;
}

void begin_to_observe(kernel::Scheduler& scheduler, Time now) {
  for (const kernel::Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next)
    if (is_thread(*task)) thread_of(*task).woken_by_timer = false;
  observes = true;
  observes_since = now;
  fired_before = timers_fired;
  observer.event = observe;
  observer.next = kernel::watch(scheduler);
  kernel::set_watch(scheduler, &observer);
  family::own->written = written_by(*family::own);
}

}  // namespace

void begin_idle_watch(const kernel::Scheduler& scheduler) {
  idleness().woken_at = std::max(idleness().woken_at, kernel::global_time(scheduler));
  check_at = limit() > Duration() ? later(kernel::global_time(scheduler), unobserved()) : Time::max();
}

Time next_idle_check() { return check_at; }

bool is_idle(kernel::Scheduler& scheduler) {
  const Time now = kernel::next_event_time(scheduler);
  if (now < check_at || now == Time::max() || check_at == Time::max()) return false;
  check_at = later(now, between_checks());
  if (!observes) {
    begin_to_observe(scheduler, now);
    return false;
  }
  Idleness& idle = idleness();
  idle.events += timers_fired - std::exchange(fired_before, timers_fired);
  if (idle.events < events_least || anybody_outside()) return false;
  const Time alone_since = std::max(idle.acted_at, observes_since);
  const bool is_alone = now - alone_since >= std::min(limit(), timers_only_at_most) && can_nobody_continue(scheduler);
  if (!is_alone && now - later(idle.woken_at, unobserved()) < limit()) return false;
  if (!has_written()) return true;
  note_wake_up(scheduler, now);
  return false;
}

}  // namespace waitpoint::posix
