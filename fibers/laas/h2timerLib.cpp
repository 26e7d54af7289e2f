// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/h2timerLib.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "fibers/laas/semaphore.hpp"

namespace waitpoint::laas {

struct H2TIMER : TickAction {
  enum class Status : std::uint8_t { stopped, wait_delay, running };

  bool allocated() const { return fired.has_value() && fired->kind() != Semaphore::Kind::none; }

  // Counts the firings without a waiter, until the caller's time.
  void catch_up() {
    if (status == Status::stopped || Ticks::listed(*this)) return;
    const std::int64_t now = ticks->now();
    if (now < next) return;
    const std::int64_t firings = (now - next) / period + 1;
    next += firings * period;
    status = Status::running;
    constexpr std::int64_t most = std::numeric_limits<int>::max();
    fired->count = static_cast<int>(std::min(most, fired->count + firings));
  }

  // With a waiter, the next firing is an event.
  void list() {
    ticks->unlist(*this);
    if (status != Status::stopped && fired->has_waiters()) ticks->list(*this, next, rank);
  }

  void at_tick() override {
    next += period;
    status = Status::running;
    fired->hand_over();
    list();
  }

  Ticks* ticks = nullptr;
  std::optional<Semaphore> fired;
  std::uint64_t rank = 0;
  Status status = Status::stopped;
  int period = 1;
  std::int64_t next = 0;  // the tick of the next firing
};

namespace {

using kernel::Operation;

struct Timers : sync::RobotState {
  explicit Timers(kernel::Robot& robot) {
    for (std::size_t i = 0; i < table.size(); ++i) {
      table[i].ticks = &sync::state_of<Ticks>(robot);
      table[i].fired.emplace(robot, "h2 timer");
      // After all watchdogs.
      table[i].rank = (std::uint64_t{1} << 63) + i;
    }
  }
  std::array<H2TIMER, NMAX_TIMERS> table;
};

bool is_timer(H2TIMER_ID timer) { return timer != nullptr && timer->allocated(); }

// Blocks until the timer fires, unless it has; false if it was freed meanwhile.
bool wait(H2TIMER& timer) {
  if (!timer.allocated()) return false;
  timer.catch_up();
  if (timer.fired->count > 0) {
    --timer.fired->count;
    return true;
  }
  // Listed before blocking, since other tasks run then.
  if (timer.status != H2TIMER::Status::stopped && !Ticks::listed(timer))
    timer.ticks->list(timer, timer.next, timer.rank);
  return timer.fired->wait(Time::max()) == TakeResult::taken;
}

}  // namespace

H2TIMER_ID h2timerAlloc() {
  if (!Ticks::here().running()) {
    fail(S_h2timerLib_TIMER_NOT_INIT);
    return nullptr;
  }
  for (H2TIMER& timer : sync::state_of<Timers>(*sync::running_task().robot).table) {
    if (timer.allocated()) continue;
    timer.fired->create(Semaphore::Kind::count, 0);
    timer.status = H2TIMER::Status::stopped;
    return &timer;
  }
  fail(S_h2timerLib_TOO_MUCH_TIMERS);
  return nullptr;
}

STATUS h2timerStart(H2TIMER_ID timerId, int period, int delay) {
  if (!is_timer(timerId)) return fail(S_h2timerLib_TIMER_NOT_INIT);
  if (period <= 0) return fail(S_h2timerLib_BAD_PERIOD);
  if (delay < 0 || delay >= MAX_DELAY) return fail(S_h2timerLib_BAD_DELAY);
  H2TIMER& timer = *timerId;
  if (!sync::before_releasing(Operation::timer_start, timer.fired->object())) return OK;
  if (timer.status != H2TIMER::Status::stopped) return fail(S_h2timerLib_NOT_STOPPED_TIMER);
  timer.status = H2TIMER::Status::wait_delay;
  timer.period = period;
  timer.fired->count = 0;
  const std::int64_t first = timer.ticks->now() + 1;
  timer.next = first + (delay - first % MAX_DELAY + MAX_DELAY) % MAX_DELAY;
  timer.list();
  return OK;
}

STATUS h2timerPause(H2TIMER_ID timerId) {
  if (!is_timer(timerId)) return fail(S_h2timerLib_TIMER_NOT_INIT);
  H2TIMER& timer = *timerId;
  if (!sync::before_blocking(Operation::timer_wait, timer.fired->object())) return OK;
  if (!wait(timer)) return fail(S_h2timerLib_TIMER_NOT_INIT);
  timer.fired->count = 0;
  return OK;
}

STATUS h2timerPauseReset(H2TIMER_ID timerId) {
  if (!is_timer(timerId)) return fail(S_h2timerLib_TIMER_NOT_INIT);
  H2TIMER& timer = *timerId;
  if (!sync::before_blocking(Operation::timer_wait, timer.fired->object())) return OK;
  if (!wait(timer)) return fail(S_h2timerLib_TIMER_NOT_INIT);
  if (timer.status != H2TIMER::Status::running) return OK;
  timer.next = timer.ticks->now() + timer.period;
  timer.list();
  return OK;
}

STATUS h2timerStop(H2TIMER_ID timerId) {
  if (!is_timer(timerId)) return fail(S_h2timerLib_TIMER_NOT_INIT);
  H2TIMER& timer = *timerId;
  if (!sync::before_releasing(Operation::timer_stop, timer.fired->object())) return OK;
  timer.catch_up();
  timer.status = H2TIMER::Status::stopped;
  timer.list();
  return OK;
}

STATUS h2timerChangePeriod(H2TIMER_ID timerId, int period) {
  if (!is_timer(timerId)) return fail(S_h2timerLib_TIMER_NOT_INIT);
  if (period <= 0) return fail(S_h2timerLib_BAD_PERIOD);
  H2TIMER& timer = *timerId;
  if (!sync::before_releasing(Operation::timer_start, timer.fired->object())) return OK;
  if (timer.status == H2TIMER::Status::stopped) return fail(S_h2timerLib_STOPPED_TIMER);
  timer.catch_up();
  if (timer.status == H2TIMER::Status::running) {
    const std::int64_t now = timer.ticks->now();
    const std::int64_t passed = (now - (timer.next - timer.period)) % period;
    timer.next = now + period - passed;
  }
  timer.period = period;
  timer.list();
  return OK;
}

STATUS h2timerFree(H2TIMER_ID timerId) {
  if (!is_timer(timerId)) return fail(S_h2timerLib_TIMER_NOT_INIT);
  H2TIMER& timer = *timerId;
  if (!sync::before_releasing(Operation::timer_stop, timer.fired->object())) return OK;
  if (!is_timer(timerId)) return fail(S_h2timerLib_TIMER_NOT_INIT);  // another task freed it first
  timer.status = H2TIMER::Status::stopped;
  timer.ticks->unlist(timer);
  timer.fired->destroy();
  return OK;
}

}  // namespace waitpoint::laas
