// SPDX-License-Identifier: BSD-3-Clause
//
// setitimer() and alarm(): signals to the process, on virtual time or on its processor time.
#include "fibers/posix/timers/interval_timers.hpp"

#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/time/clocks.hpp"
#include "fibers/posix/timers/signal_timer.hpp"

namespace waitpoint::posix {
namespace {

constexpr int signal_of[] = {SIGALRM, SIGVTALRM, SIGPROF};
constexpr int microsecond_ns = 1000;

void expire_interval(SignalTimer& timer, std::uint64_t);

// Indexed by ITIMER_REAL, ITIMER_VIRTUAL, ITIMER_PROF.
SignalTimer interval_timers[3] = {SignalTimer(expire_interval), SignalTimer(expire_interval),
                                  SignalTimer(expire_interval)};
static_assert(std::size(interval_timers) == std::size(signal_of), "each timer has a signal");
static_assert(ITIMER_REAL == 0 && ITIMER_VIRTUAL == 1 && ITIMER_PROF == 2, "the timers are indexed by these");

void expire_interval(SignalTimer& timer, std::uint64_t) {
  WAITPOINT_CHECK(&timer >= interval_timers && &timer < std::end(interval_timers),
                  "a timer of another kind rings as setitimer()'s");
  siginfo_t information{};
  information.si_signo = signal_of[&timer - interval_timers];
  information.si_code = SI_KERNEL;
  send(information, nullptr);
}

timeval to_timeval(Duration span) {
  const timespec time = to_timespec(span.ns());
  return {time.tv_sec, time.tv_nsec / microsecond_ns};
}

Duration span_of(const timeval& time) { return span({time.tv_sec, time.tv_usec * microsecond_ns}); }

bool is_valid_time(const timeval& time) { return time.tv_sec >= 0 && time.tv_usec >= 0 && time.tv_usec < 1'000'000; }

itimerval state_of(const SignalTimer& timer) { return {to_timeval(timer.interval()), to_timeval(timer.left())}; }

void start(int which, Duration first, Duration interval) {
  WAITPOINT_CHECK(which >= 0 && which < std::ssize(interval_timers), "a timer that does not exist is started");
  SignalTimer& timer = interval_timers[which];
  if (first == Duration())
    timer.stop();
  else if (which == ITIMER_REAL)
    timer.start(later(kernel::local_time(*kernel::running), first), interval);
  else
    timer.start(this_program().spent, this_program().spent + first, interval);
}

}  // namespace

void forget_interval_timers() {
  for (SignalTimer& timer : interval_timers) timer.stop();
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
  const itimerval before = state_of(interval_timers[number]);
  start(number, to == nullptr ? Duration() : span_of(to->it_value),
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
  read_clock();
  *state = state_of(interval_timers[number]);
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
