// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/local_clock.hpp"

#include <gtest/gtest.h>

#include <string>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "tests/fibers/kernel/task_run.hpp"

namespace waitpoint::kernel {
namespace {

// Each segment consumes the nanoseconds that the test sets beforehand.
struct SetClock : LocalClock {
  SetClock() {
    begin = [](LocalClock& self, Task&) { static_cast<SetClock&>(self).runs = true; };
    end = [](LocalClock& clock, Task& task) {
      auto& self = static_cast<SetClock&>(clock);
      if (!self.runs) return;
      self.runs = false;
      ++self.ends;
      task.local_time += Duration::from_ns(self.consumed_ns);
      self.consumed_ns = 0;
    };
    compute = [](LocalClock& self, Task& task, Duration least, Duration greatest) {
      static_cast<SetClock&>(self).declared += greatest + least;
      task.local_time += least;
    };
  }
  bool runs = false;
  int ends = 0;
  std::int64_t consumed_ns = 0;
  Duration declared;
};

TEST(LocalClock, SegmentCostIsInTheLocalTimeBeforeItsWaitpoint) {
  TaskRun run;
  SetClock clock;
  Object object("object");
  run.spawn(
      [&] {
        run.log("start");
        clock.consumed_ns = 10;
        kernel::waitpoint(run.scheduler, Operation::lock, &object);
        run.log("waitpoint");
        clock.consumed_ns = 5;
        kernel::yield(run.scheduler);
        run.log("yield");
        clock.consumed_ns = 5;
        run.sleep(50);
        run.log("sleep");  // until 50, regardless of the previous cost
        clock.consumed_ns = 30;
        run.sleep(60);
        run.log("late");
        clock.consumed_ns = 20;  // cost of its last segment
      },
      {.clock = &clock});
  run.spawn([&] {
    for (const int ns : {9, 11, 19, 21, 49, 51, 79, 81, 99, 101}) {
      run.sleep(ns);
      run.trace += ". ";
    }
  });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
  EXPECT_EQ(run.trace, "start@0 . waitpoint@10 . yield@15 . . . sleep@50 . . late@80 . . . ");
  EXPECT_EQ(clock.ends, 5);
}

TEST(LocalClock, NowIncludesWhatTheRunningSegmentConsumedSoFar) {
  TaskRun run;
  SetClock clock;
  run.spawn(
      [&] {
        clock.consumed_ns = 10;
        EXPECT_EQ(local_time(*running).ns(), 10);
        clock.consumed_ns = 20;
        EXPECT_EQ(local_time(*running).ns(), 30);
        clock.consumed_ns = 3;
        run.spawn([&] { run.log("child"); });
        clock.consumed_ns = 4;
        kernel::yield(run.scheduler);
        run.log("task");
      },
      {.clock = &clock});
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_EQ(run.trace, "child@33 task@37 ");
}

TEST(LocalClock, TimeBetweenAWaitpointAndTheBlockAfterItDoesNotCount) {
  TaskRun run;
  SetClock clock;
  Object object("object");
  run.spawn(
      [&] {
        kernel::waitpoint(run.scheduler, Operation::wait, &object);
        clock.consumed_ns = 1000;
        EXPECT_EQ(kernel::block(run.scheduler, object, Time::from_ns(40)), Wake::timed_out);
        run.log("timeout");
        clock.consumed_ns = 5;
        kernel::waitpoint(run.scheduler, Operation::wait, &object);
        EXPECT_EQ(kernel::block(run.scheduler, object, Time::max()), Wake::woken);
        run.log("woken");
      },
      {.clock = &clock});
  run.spawn([&] {
    run.sleep(45);
    kernel::yield(run.scheduler);
    kernel::wake_one(run.scheduler, object);
  });
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_EQ(run.trace, "timeout@40 woken@45 ");
}

TEST(LocalClock, DeclaredCostsGoThroughTheClock) {
  TaskRun run;
  SetClock clock;
  run.spawn(
      [&] {
        compute(*running, Duration::from_ns(7));
        compute(*running, Duration::from_ns(1), Duration::from_ns(5));
        EXPECT_EQ(local_time(*running).ns(), 8);
      },
      {.clock = &clock});
  run.spawn([&] {
    compute(*running, Duration::from_ns(7));
    compute(*running, Duration::from_ns(1), Duration::from_ns(5));
    EXPECT_EQ(local_time(*running).ns(), 12);  // without a clock: the greatest cost
  });
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_EQ(clock.declared.ns(), 14 + 6);
}

// The task has already called its operation when the handler runs: the operation comes after the handler.
TEST(Signals, AreDeliveredAtTheNextWaitpointAndTheOperationComesAfterTheHandler) {
  static TaskRun* run = nullptr;
  for (const bool with_clock : {false, true}) {
    TaskRun here;
    run = &here;
    SetClock clock;
    kernel::hooks(here.scheduler).deliver_signals = [](Task& task) {
      run->log("handler");
      compute(task, Duration::from_ns(20));
      kernel::yield(run->scheduler);
      compute(task, Duration::from_ns(5));
    };
    Task& task = here.spawn(
        [&] {
          here.sleep(10);
          here.log("a");
          here.sleep(11);
          here.log("b");
        },
        {.clock = with_clock ? &clock : nullptr});
    here.spawn([&] {
      here.sleep(5);
      task.attention |= attention::signal;
      here.sleep(25);
      here.log("between");
    });
    kernel::run_before(here.scheduler, Time::max());
    EXPECT_EQ(here.trace, "handler@10 between@25 a@35 b@35 ");
    EXPECT_EQ(task.attention & attention::signal, 0);
  }
}

TEST(LocalClock, TheEndOfAWindowEndsNoSegmentTwice) {
  SetClock clock;
  TaskRun run;
  run.spawn(
      [&] {
        clock.consumed_ns = 10;
        run.sleep(0);
        run.log("a");
        clock.consumed_ns = 10;
        run.sleep(0);
        run.log("b");
      },
      {.clock = &clock});
  for (int until = 1; until < 30; ++until) kernel::run_before(run.scheduler, Time::from_ns(until));
  EXPECT_EQ(run.trace, "a@10 b@20 ");
}

}  // namespace
}  // namespace waitpoint::kernel
