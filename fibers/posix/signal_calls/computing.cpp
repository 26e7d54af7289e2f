// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/signal_calls/computing.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <ctime>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/computing_watch.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {

void (*expect_computing)() = nullptr;

namespace {

// A thread that has computed for so long, in processor time of the system, is taken for one in a loop without calls.
constexpr Duration patience = Duration(std::chrono::milliseconds(100));
// From then on it is interrupted more often.
constexpr Duration tick = Duration(std::chrono::milliseconds(5));
// The virtual time that it spends at a tick without a timer that expires earlier.
constexpr Duration spent_at_most = Duration(std::chrono::milliseconds(100));

timer_t ticker{};
pid_t ticker_is_of = 0;

/// What changes with each call of a thread.
struct State {
  const kernel::Task* task = nullptr;
  std::uint64_t events = 0;
  std::int64_t spent_ns = 0;
  std::uint32_t operations = 0, looks = 0;
  bool operator==(const State&) const = default;
};
State at_last_tick;

State state() {
  const Thread& thread = this_thread();
  return {thread.task, thread.task->sequence, thread.spent.ns(), thread.operations, thread.looks};
}

void set_ticker(Duration after) {
  if (ticker_is_of != getpid()) {
    struct sigevent event {};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = bell;
    event.sigev_value.sival_ptr = &ticker;
    if (WAITPOINT_NEXT(syscall)(SYS_timer_create, CLOCK_PROCESS_CPUTIME_ID, &event, &ticker) != 0) return;
    ticker_is_of = getpid();
    install_bell();
  }
  const itimerspec time{{0, 0}, to_timespec(after.ns())};
  WAITPOINT_NEXT(syscall)(SYS_timer_settime, ticker, 0, &time, nullptr);
}

bool may_be_cancelled(const Thread& thread) { return thread.cancel_at_once && !thread.cancel_disabled; }

bool is_measured(const Thread& thread, const ProcessorTimer& timer) {
  return timer.spent == &thread.spent || timer.spent == &thread.program->spent;
}

bool is_awaited(const Thread& thread) {
  for (const ProcessorTimer* timer = first_processor_timer; timer != nullptr; timer = timer->next)
    if (is_measured(thread, *timer)) return true;
  return may_be_cancelled(thread);
}

bool is_any_awaited() {
  if (first_processor_timer != nullptr) return true;
  for (const kernel::Task* task = first_task(); task != nullptr; task = task->next)
    if (is_thread(*task) && may_be_cancelled(thread_of(*task))) return true;
  return false;
}

void begin_to_tick() {
  if (!is_simulated()) return;
  const ErrorNumberKept kept;
  at_last_tick = {};
  set_ticker(patience);
}

}  // namespace

void prepare_to_watch_computing() { expect_computing = begin_to_tick; }

bool is_tick(const siginfo_t& information) {
  return information.si_signo == bell && information.si_code == SI_TIMER && information.si_value.sival_ptr == &ticker;
}

bool is_to_be_interrupted() {
  if (!is_simulated()) {
    set_ticker(patience);
    return false;
  }
  const State now = state();
  const bool computes = now == at_last_tick && is_awaited(this_thread());
  at_last_tick = now;
  if (computes)
    set_ticker(tick);
  else if (is_any_awaited())
    set_ticker(patience);
  return computes;
}

void spend_tick() {
  const Thread& thread = this_thread();
  Duration cost = spent_at_most;
  for (const ProcessorTimer* timer = first_processor_timer; timer != nullptr; timer = timer->next)
    if (is_measured(thread, *timer) && timer->due - *timer->spent < cost) cost = timer->due - *timer->spent;
  WAITPOINT_CHECK(cost > Duration(), "a timer on processor time was not looked at when due");
  spend(cost);
  pass(kernel::Operation::poll, nullptr);
  if (thread.cancel_at_once) leave_if_cancelled();
  at_last_tick = state();
}

}  // namespace waitpoint::posix
