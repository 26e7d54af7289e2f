// SPDX-License-Identifier: BSD-3-Clause
//
// timer_create() and related calls. A timer's signal is pending once at most; further expirations are reported as its
// overrun when it is taken.
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/time/clocks.hpp"
#include "fibers/posix/timers/notification_threads.hpp"
#include "fibers/posix/timers/program_timers.hpp"
#include "fibers/posix/timers/signal_timer.hpp"

namespace waitpoint::posix {
namespace {

struct Timer : PendingSignal, SignalTimer {
  explicit Timer(Program& owner);

  Program& program;
  clockid_t clock = CLOCK_REALTIME;
  // On a clock of processor time: that of a program, or of the thread with this id.
  const Program* of_program = nullptr;
  int of_thread = 0;
  sigevent notification{};
  Notice notice;  // of SIGEV_THREAD
  int to = 0;     // of SIGEV_THREAD_ID: the thread's gettid()
  bool pends = false;
  std::uint64_t overrun = 0;  // since it is pending
  int told = 0;               // the overrun of the signal taken last
};

}  // namespace

struct CreatedTimers {
  Timer** at = nullptr;  ///< by number; grows as needed
  std::size_t end = 0;
};

namespace {

int capped(std::uint64_t count) { return count > INT_MAX ? INT_MAX : static_cast<int>(count); }

void note_taken(PendingSignal& signal) {
  auto& timer = static_cast<Timer&>(signal);
  WAITPOINT_CHECK(timer.pends, "the signal of a timer is taken that is not pending");
  timer.pends = false;
  timer.told = signal.information.si_overrun = capped(timer.overrun);
}

// Null if it is sent to the program, or the thread has ended.
Thread* receiver_of(const Timer& timer) {
  for (kernel::Task* task = kernel::first_task(*timer.program.robot->scheduler); timer.to != 0 && task != nullptr;
       task = task->next)
    if (is_thread(*task) && thread_of(*task).program == &timer.program && thread_of(*task).id == timer.to)
      return &thread_of(*task);
  return nullptr;
}

void ring(SignalTimer& expired, std::uint64_t count) {
  auto& timer = static_cast<Timer&>(expired);
  WAITPOINT_CHECK(count > 0, "a timer rings without an expiration");
  switch (timer.notification.sigev_notify) {
    case SIGEV_NONE: return;
    case SIGEV_THREAD: timer.notice.ring(); return;
    default: break;
  }
  if (timer.pends) {
    timer.overrun += count;
    return;
  }
  Thread* const receiver = receiver_of(timer);
  if (timer.to != 0 && receiver == nullptr) return;
  timer.overrun = count - 1;
  timer.pends = true;
  send(timer, timer.program, receiver);
}

Timer::Timer(Program& owner) : SignalTimer(ring), program(owner) { taken = note_taken; }

Timer* find_timer(timer_t id) {
  const auto number = reinterpret_cast<std::uintptr_t>(id);
  const CreatedTimers* const timers = this_program().created_timers;
  return timers != nullptr && number < timers->end ? timers->at[number] : nullptr;
}

// Returns an error number or 0.
int prepare(Timer& timer, sigevent* event) {
  if (event == nullptr) {
    timer.notification.sigev_notify = SIGEV_SIGNAL;
    timer.notification.sigev_signo = SIGALRM;
    return 0;
  }
  timer.notification = *event;
  switch (event->sigev_notify) {
    case SIGEV_NONE: return 0;
    case SIGEV_SIGNAL: break;
    case SIGEV_THREAD: return timer.notice.prepare(*event) ? 0 : EAGAIN;
    case SIGEV_THREAD_ID:
      timer.to = event->_sigev_un._tid;
      if (receiver_of(timer) == nullptr) return EINVAL;
      break;
    default: return EINVAL;
  }
  return is_signal(event->sigev_signo) ? 0 : EINVAL;
}

int number_for_new(Program& program) {
  if (program.created_timers == nullptr) {
    void* const memory = std::malloc(sizeof(CreatedTimers));
    if (memory == nullptr) return -1;
    program.created_timers = new (memory) CreatedTimers();
  }
  CreatedTimers& timers = *program.created_timers;
  for (std::size_t i = 0; i < timers.end; ++i)
    if (timers.at[i] == nullptr) return static_cast<int>(i);
  auto** const more = static_cast<Timer**>(std::realloc(timers.at, (timers.end + 1) * sizeof(void*)));
  if (more == nullptr) return -1;
  timers.at = more;
  timers.at[timers.end] = nullptr;
  return static_cast<int>(timers.end++);
}

// Returns an error number.
int take_clock(Timer& timer, clockid_t clock) {
  timer.clock = clock;
  const bool of_processor = is_processor_clock(clock);
  if (clock == CLOCK_THREAD_CPUTIME_ID || (of_processor && is_thread_clock(clock))) {
    const int owner = of_processor ? owner_of(clock) : 0;
    timer.of_thread = owner != 0 ? owner : this_thread().id;
    return thread_with_id(timer.of_thread) != nullptr ? 0 : EINVAL;
  }
  if (clock == CLOCK_PROCESS_CPUTIME_ID || (of_processor && (owner_of(clock) == 0 || owner_of(clock) == getpid()))) {
    timer.of_program = &this_program();
    return 0;
  }
  if (clock == CLOCK_REALTIME || clock == CLOCK_MONOTONIC || clock == CLOCK_BOOTTIME || clock == CLOCK_TAI) return 0;
  return is_clock(clock) || is_device_clock(clock) ? ENOTSUP : EINVAL;
}

bool counts_processor_time(const Timer& timer) { return timer.of_program != nullptr || timer.of_thread != 0; }

// Null if its thread has ended.
const Duration* spent_on(const Timer& timer) {
  if (timer.of_program != nullptr) return &timer.of_program->spent;
  const Thread* const thread = thread_with_id(timer.of_thread);
  return thread != nullptr ? &thread->spent : nullptr;
}

itimerspec state_of(const Timer& timer) { return {to_timespec(timer.interval().ns()), to_timespec(timer.left().ns())}; }

void free_timer(CreatedTimers& timers, std::size_t number) {
  WAITPOINT_CHECK(number < timers.end && timers.at[number] != nullptr, "a timer that does not exist is freed");
  Timer* const timer = timers.at[number];
  timer->stop();
  timer->program.signals.pending.remove(*timer);
  if (Thread* const receiver = receiver_of(*timer); receiver != nullptr) receiver->pending.remove(*timer);
  timer->~Timer();
  std::free(timer);
  timers.at[number] = nullptr;
}

}  // namespace

void forget_created_timers(Program& program) {
  if (program.created_timers == nullptr) return;
  CreatedTimers& timers = *program.created_timers;
  for (std::size_t i = 0; i < timers.end; ++i)
    if (timers.at[i] != nullptr) free_timer(timers, i);
  std::free(timers.at);
  std::free(&timers);
  program.created_timers = nullptr;
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int timer_create(clockid_t clock, sigevent* event, timer_t* id) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(timer_create)(clock, event, id);
  if ((event != nullptr && !can_be_read(event)) || !can_be_written(id)) return fail(EFAULT);
  before_call<"timer_create">(changing(place::timers));
  void* const memory = std::malloc(sizeof(Timer));
  if (memory == nullptr) return fail(EAGAIN);
  auto* const timer = new (memory) Timer(this_program());
  int error = take_clock(*timer, clock);
  // Other threads may run meanwhile, and make timers.
  if (error == 0) error = prepare(*timer, event);
  const int number = error == 0 ? number_for_new(this_program()) : -1;
  if (error == 0 && number < 0) error = EAGAIN;
  if (error != 0) {
    timer->~Timer();
    std::free(memory);
    return fail(error);
  }
  timer->information.si_signo = timer->notification.sigev_signo;
  timer->information.si_code = SI_TIMER;
  timer->information.si_timerid = number;
  if (event != nullptr)
    timer->information.si_value = event->sigev_value;
  else
    timer->information.si_int = number;
  Timer*& place = this_program().created_timers->at[number];
  WAITPOINT_CHECK(place == nullptr, "the number of a new timer is another's");
  place = timer;
  *id = reinterpret_cast<timer_t>(static_cast<std::uintptr_t>(number));
  return 0;
}

WAITPOINT_INTERPOSED int timer_settime(timer_t id, int flags, const itimerspec* to, itimerspec* old) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(timer_settime)(id, flags, to, old);
  if (to == nullptr) return fail(EINVAL);
  if (!can_be_read(to) || (old != nullptr && !can_be_written(old))) return fail(EFAULT);
  if (!is_valid(to->it_value) || to->it_value.tv_sec < 0 || !is_valid(to->it_interval) || to->it_interval.tv_sec < 0)
    return fail(EINVAL);
  if (find_timer(id) == nullptr) return fail(EINVAL);
  pass(kernel::Operation::timer_start, nullptr);
  Timer* const timer = find_timer(id);
  if (timer == nullptr) return fail(EINVAL);  // another thread has deleted it meanwhile
  const bool by_processor = counts_processor_time(*timer);
  const Duration* const spent = by_processor ? spent_on(*timer) : nullptr;
  if (by_processor && spent == nullptr) return fail(ESRCH);
  const itimerspec before = state_of(*timer);
  const Duration first = span(to->it_value), interval = span(to->it_interval);
  const bool is_date = (flags & TIMER_ABSTIME) != 0;
  timer->overrun = 0;
  timer->told = 0;
  if (first == Duration())
    timer->stop();
  else if (by_processor)
    timer->start(*spent, is_date ? first : *spent + first, interval);
  else
    timer->start(is_date ? when(timer->clock, to->it_value) : later(kernel::local_time(*kernel::running), first),
                 interval, is_date ? passed_since(timer->clock, to->it_value) : Duration());
  if (old != nullptr) *old = before;
  return 0;
}

WAITPOINT_INTERPOSED int timer_gettime(timer_t id, itimerspec* state) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(timer_gettime)(id, state);
  before_call<"timer_gettime">(reading(place::timers));
  const Timer* const timer = find_timer(id);
  if (timer == nullptr) return fail(EINVAL);
  if (!can_be_written(state)) return fail(EFAULT);
  read_clock();
  *state = state_of(*timer);
  return 0;
}

WAITPOINT_INTERPOSED int timer_getoverrun(timer_t id) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(timer_getoverrun)(id);
  before_call<"timer_getoverrun">(reading(place::timers));
  const Timer* const timer = find_timer(id);
  return timer == nullptr ? fail(EINVAL) : timer->told;
}

WAITPOINT_INTERPOSED int timer_delete(timer_t id) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(timer_delete)(id);
  if (find_timer(id) == nullptr) return fail(EINVAL);
  pass(kernel::Operation::timer_stop, nullptr);
  if (find_timer(id) == nullptr) return fail(EINVAL);  // so has another thread meanwhile
  free_timer(*this_program().created_timers, reinterpret_cast<std::uintptr_t>(id));
  return 0;
}
