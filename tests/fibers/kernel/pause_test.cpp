// SPDX-License-Identifier: BSD-3-Clause
// Pausing a run, after some or all events, does not change it.
#include <gtest/gtest.h>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/kernel/watch.hpp"
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
    if (++seen % period == 0) kernel::pause(scheduler);
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
        for (int k = 0; k < (i == 3 ? 2500 : 5); ++k) kernel::waitpoint(run.scheduler, Operation::try_lock, &other);
        kernel::waitpoint(run.scheduler, Operation::wait, &object);
        if (t == 0)
          kernel::wake_all(run.scheduler, object);
        else
          kernel::block(run.scheduler, object, Time::from_ns(10 * i + t));
        kernel::yield(run.scheduler);
      }
    });
  }
  Pauses pauses(run.scheduler, period);
  if (period > 0) kernel::set_watch(run.scheduler, &pauses);
  Result result{};
  while (kernel::run_before(run.scheduler, Time::max()) == RunState::reached) {
    ++result.calls;
    EXPECT_EQ(pauses.seen, kernel::events(run.scheduler)) << "another event came after the pause";
    EXPECT_EQ(pauses.seen % period, 0u) << "another event came after the pause";
  }
  EXPECT_EQ(kernel::stop_cause(run.scheduler), StopCause::ended);
  result.digest = run.robot.digest.value();
  result.events = kernel::events(run.scheduler);
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
    kernel::pause(run.scheduler);
    run.log("b");
    run.sleep(5);
    run.log("c");
  });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::reached);
  EXPECT_EQ(run.trace, "a@0 b@0 ");
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
  EXPECT_EQ(run.trace, "a@0 b@0 c@5 ");
}

}  // namespace
}  // namespace waitpoint::kernel
