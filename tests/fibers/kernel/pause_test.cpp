// SPDX-License-Identifier: BSD-3-Clause
// Pausing a run, after some or all events, does not change it.
#include <gtest/gtest.h>

#include "tests/fibers/kernel/task_run.hpp"

namespace waitpoint::kernel {
namespace {

/// Pauses after every `period`-th event.
struct Pauses : Watch {
  explicit Pauses(Scheduler& scheduler, std::uint64_t period)
      : Watch{[](Watch& watch, const EventRecord&) { static_cast<Pauses&>(watch).see(); }},
        scheduler(scheduler),
        period(period) {}
  void see() {
    if (++seen % period == 0) scheduler.pause();
  }
  Scheduler& scheduler;
  std::uint64_t period, seen = 0;
};

struct Result {
  std::uint64_t digest, events;
  std::string trace;
  int calls = 0;
  bool operator==(const Result& other) const {
    return digest == other.digest && events == other.events && trace == other.trace;
  }
};

// Ties, waits with and without timeouts, turns yielded after many waitpoints at one instant.
Result result_of(Order order, std::uint64_t seed, std::uint64_t period) {
  TaskRun run(order, seed);
  Object object("object"), other("other");
  for (int t = 0; t < 4; ++t) {
    run.spawn([&run, &object, &other, t] {
      for (int i = 1; i <= 5; ++i) {
        run.sleep(10 * i);
        run.log(std::to_string(t));
        for (int k = 0; k < (i == 3 ? 2500 : 5); ++k) run.scheduler.waitpoint(Operation::try_lock, &other);
        run.scheduler.waitpoint(Operation::wait, &object);
        if (t == 0)
          run.scheduler.wake_all(object);
        else
          run.scheduler.block(object, Time::from_ns(10 * i + t));
        run.scheduler.yield();
      }
    });
  }
  Pauses pauses(run.scheduler, period);
  if (period > 0) run.scheduler.set_watch(&pauses);
  Result result{};
  while (run.scheduler.run_before(Time::max()) == RunState::reached) {
    ++result.calls;
    EXPECT_EQ(pauses.seen, run.scheduler.events()) << "another event came after the pause";
    EXPECT_EQ(pauses.seen % period, 0u) << "another event came after the pause";
  }
  EXPECT_EQ(run.scheduler.stop_cause(), StopCause::ended);
  result.digest = run.robot.digest.value();
  result.events = run.scheduler.events();
  result.trace = run.trace;
  return result;
}

TEST(Pause, ChangesNothingInTheDefaultOrder) {
  const Result free = result_of(Order::fifo, 0, 0);
  for (const std::uint64_t period : {1, 2, 3, 7, 100}) {
    const Result paused = result_of(Order::fifo, 0, period);
    EXPECT_EQ(paused, free) << period;
    EXPECT_GE(paused.calls, static_cast<int>(free.events / period) - 1) << "it pauses each time it is asked";
  }
}

TEST(Pause, ChangesNothingInSeededOrders) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Result free = result_of(Order::seeded, seed, 0);
    EXPECT_EQ(result_of(Order::seeded, seed, 1), free) << seed;
    EXPECT_EQ(result_of(Order::seeded, seed, 5), free) << seed;
  }
}

TEST(Pause, FromATaskStopsBeforeItsNextEvent) {
  TaskRun run;
  run.spawn([&] {
    run.log("a");
    run.scheduler.pause();
    run.log("b");
    run.sleep(5);
    run.log("c");
  });
  EXPECT_EQ(run.scheduler.run_before(Time::max()), RunState::reached);
  EXPECT_EQ(run.trace, "a@0 b@0 ");
  EXPECT_EQ(run.scheduler.run_before(Time::max()), RunState::stopped);
  EXPECT_EQ(run.trace, "a@0 b@0 c@5 ");
}

}  // namespace
}  // namespace waitpoint::kernel
