// SPDX-License-Identifier: BSD-3-Clause
//
// setitimer() and alarm(): signals to the process, on virtual time or on its processor time.
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <new>

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/time/clocks.hpp"
#include "fibers/posix/timers/program_timers.hpp"
#include "fibers/posix/timers/signal_timer.hpp"

namespace waitpoint::posix {
namespace {

constexpr int microsecond_ns = 1000;

struct IntervalTimer : SignalTimer {
  IntervalTimer(Program& of, int by);
  Program& program;
  int signal;
};

}  // namespace

struct IntervalTimers {
  explicit IntervalTimers(Program& program)
      : at{IntervalTimer(program, SIGALRM), IntervalTimer(program, SIGVTALRM), IntervalTimer(program, SIGPROF)} {}
  IntervalTimer at[3];
};
static_assert(ITIMER_REAL == 0 && ITIMER_VIRTUAL == 1 && ITIMER_PROF == 2, "the timers are indexed by these");

namespace {

void expire_interval(SignalTimer& expired, std::uint64_t) {
  const auto& timer = static_cast<IntervalTimer&>(expired);
  siginfo_t information{};
  information.si_signo = timer.signal;
  information.si_code = SI_KERNEL;
  send(information, timer.program);
}

IntervalTimer::IntervalTimer(Program& of, int by) : SignalTimer(expire_interval), program(of), signal(by) {}

// The running program's timer of this number; null without memory.
SignalTimer* timer_of_program(int which) {
  Program& program = this_program();
  if (program.interval_timers == nullptr) {
    void* const memory = std::malloc(sizeof(IntervalTimers));
    if (memory == nullptr) return nullptr;
    program.interval_timers = new (memory) IntervalTimers(program);
  }
  return &program.interval_timers->at[which];
}

timeval to_timeval(Duration span) {
  const timespec time = to_timespec(span.ns());
  return {time.tv_sec, time.tv_nsec / microsecond_ns};
}

Duration span_of(const timeval& time) { return span({time.tv_sec, time.tv_usec * microsecond_ns}); }

bool is_valid_time(const timeval& time) { return time.tv_sec >= 0 && time.tv_usec >= 0 && time.tv_usec < 1'000'000; }

itimerval state_of(const SignalTimer& timer) { return {to_timeval(timer.interval()), to_timeval(timer.left())}; }

void start(SignalTimer& timer, int which, Duration first, Duration interval) {
  WAITPOINT_CHECK(which >= ITIMER_REAL && which <= ITIMER_PROF, "a timer that does not exist is started");
  if (first == Duration())
    timer.stop();
  else if (which == ITIMER_REAL)
    timer.start(later(kernel::local_time(*kernel::running), first), interval);
  else
    timer.start(this_program().spent, this_program().spent + first, interval);
}

}  // namespace

void forget_interval_timers(Program& program) {
  if (program.interval_timers == nullptr) return;
  for (SignalTimer& timer : program.interval_timers->at) timer.stop();
  std::free(program.interval_timers);
  program.interval_timers = nullptr;
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int setitimer(__itimer_which_t which, const itimerval* to, itimerval* old) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(setitimer)(which, to, old);
  const int number = static_cast<int>(which);
  if (to != nullptr && !can_be_read(to)) return fail(EFAULT);
  if (number < 0 || number > 2) return fail(EINVAL);
  if (to != nullptr && (!is_valid_time(to->it_value) || !is_valid_time(to->it_interval))) return fail(EINVAL);
  pass(kernel::Operation::timer_start, nullptr);
  SignalTimer* const timer = timer_of_program(number);
  if (timer == nullptr) return fail(ENOMEM);
  const itimerval before = state_of(*timer);
  start(*timer, number, to == nullptr ? Duration() : span_of(to->it_value),
        to == nullptr ? Duration() : span_of(to->it_interval));
  if (old == nullptr) return 0;
  if (!can_be_written(old)) return fail(EFAULT);
  *old = before;
  return 0;
}

WAITPOINT_INTERPOSED int getitimer(__itimer_which_t which, itimerval* state) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(getitimer)(which, state);
  const int number = static_cast<int>(which);
  if (number < 0 || number > 2) return fail(EINVAL);
  if (!can_be_written(state)) return fail(EFAULT);
  before_call<"getitimer">(reading(place::timers));
  read_clock();
  const SignalTimer* const timer = timer_of_program(number);
  if (timer == nullptr) return fail(ENOMEM);
  *state = state_of(*timer);
  return 0;
}

WAITPOINT_INTERPOSED unsigned alarm(unsigned seconds) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(alarm)(seconds);
  itimerval old{};
  const itimerval to{{0, 0}, {static_cast<time_t>(seconds), 0}};
  setitimer(ITIMER_REAL, &to, &old);
  // Rounded, but never to zero.
  if (old.it_value.tv_usec >= 500'000 || (old.it_value.tv_sec == 0 && old.it_value.tv_usec > 0)) ++old.it_value.tv_sec;
  return static_cast<unsigned>(old.it_value.tv_sec);
}

WAITPOINT_INTERPOSED useconds_t ualarm(useconds_t first, useconds_t interval) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(ualarm)(first, interval);
  itimerval old{};
  const itimerval to{{interval / 1'000'000, interval % 1'000'000}, {first / 1'000'000, first % 1'000'000}};
  if (setitimer(ITIMER_REAL, &to, &old) != 0) return static_cast<useconds_t>(-1);
  return static_cast<useconds_t>(old.it_value.tv_sec * 1'000'000 + old.it_value.tv_usec);
}
