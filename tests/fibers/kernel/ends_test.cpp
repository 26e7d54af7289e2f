// SPDX-License-Identifier: BSD-3-Clause
// The ends of tasks, and of a run before them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fibers/kernel/local_clock.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "tests/fibers/kernel/task_run.hpp"

namespace waitpoint::kernel {
namespace {

// If the run ends while a task yields to its ties, unwinding it must not run another task.
TEST(Ends, UnwindingFromAGivenTurnRunsNoOtherTask) {
  TaskRun run;
  Object object("object");
  run.spawn([&] {
    for (std::uint32_t k = 0; k <= waitpoints_max; ++k) run.scheduler.waitpoint(Operation::try_lock, &object);
    run.log("first");
  });
  run.spawn([&] {
    run.spawn([&] { run.log(run.scheduler.unwinding() ? "unborn" : "world"); }, {.phase = Phase::world});
    run.log("stop");
    run.scheduler.stop(StopCause::requested);
  });
  EXPECT_EQ(run.scheduler.run_before(Time::max()), RunState::stopped);
  EXPECT_EQ(run.scheduler.stop_cause(), StopCause::requested);
  run.scheduler.unwind();
  EXPECT_EQ(run.trace, "stop@0 unborn@0 first@0 ");
}

// Like the threads of an exiting program: blocked, with and without a timeout, asleep, and about to begin.
TEST(Ends, TasksEndInPlaceWhereverTheyAre) {
  for (const Order order : {Order::fifo, Order::seeded}) {
    TaskRun run(order);
    Object object("object");
    std::vector<Task*> others;
    for (const Time deadline : {Time::max(), Time::from_ns(100)})
      others.push_back(&run.spawn([&run, &object, deadline] {
        run.scheduler.enter(object);
        run.scheduler.block(object, deadline);
        run.log("went on");
      }));
    others.push_back(&run.spawn([&] {
      run.sleep(50);
      run.log("woke up");
    }));
    run.spawn([&] {
      run.sleep(10);
      others.push_back(&run.spawn([&] { run.log("began"); }));
      for (Task* other : others) {
        run.scheduler.end_in_place(*other);
        run.scheduler.free_stack(*other);
      }
      EXPECT_EQ(run.scheduler.wake_one(object), nullptr);
      EXPECT_EQ(run.scheduler.roster().tasks(), 1u);
      run.sleep(200);
      run.log("alone");
    });
    EXPECT_EQ(run.scheduler.run_before(Time::max()), RunState::stopped);
    EXPECT_EQ(run.scheduler.stop_cause(), StopCause::ended);
    EXPECT_EQ(run.trace, "alone@200 ");
  }
}

TEST(Ends, ATaskEndsWhereItIs) {
  TaskRun run;
  run.spawn([&] {
    run.scheduler.waitpoint(Operation::end, nullptr);
    run.scheduler.end_running_task();
  });
  run.spawn([&] { run.log("the other"); });
  EXPECT_EQ(run.scheduler.run_before(Time::max()), RunState::stopped);
  EXPECT_EQ(run.scheduler.stop_cause(), StopCause::ended);
  EXPECT_EQ(run.trace, "the other@0 ");
}

TEST(Ends, TheYoungestTaskIsUnwoundFirst) {
  TaskRun run;
  Object object("object");
  for (const char* name : {"parent", "child", "grandchild"})
    run.spawn([&run, &object, name] {
      EXPECT_EQ(run.scheduler.block(object, Time::max()), Wake::unwinding);
      run.log(name);
    });
  EXPECT_EQ(run.scheduler.run_before(Time::max()), RunState::idle);
  run.scheduler.unwind();
  EXPECT_EQ(run.trace, "grandchild@0 child@0 parent@0 ");
}

TEST(Ends, ATaskThatGoesOnAfterTheEndIsAbandoned) {
  TaskRun run;
  Object object("object");
  run.spawn(
      [&] {
        for (;;) {
          compute(*running, Duration::from_ns(1));
          run.scheduler.waitpoint(Operation::release, &object);
        }
      },
      {.name = "endless"});
  run.spawn([&] { run.log(run.scheduler.sleep_until(Time::from_ns(1000)) ? "slept" : "left"); });
  EXPECT_EQ(run.scheduler.run_before(Time::from_ns(500)), RunState::reached);
  run.scheduler.unwind();
  EXPECT_EQ(run.trace, "left@499 ");
  ASSERT_NE(run.scheduler.roster().first_abandoned(), nullptr);
  EXPECT_STREQ(run.scheduler.roster().first_abandoned()->name, "endless");
  EXPECT_EQ(run.scheduler.roster().first_abandoned()->next, nullptr);
  EXPECT_EQ(run.scheduler.first_task(), nullptr);
}

TEST(Ends, TheDigestOfARobotIsFrozenWhenItsLastTaskEnds) {
  const auto digest = [](int service_ends) {
    TaskRun run;
    Robot other;
    run.scheduler.add(other, "other");
    run.spawn([&] { run.sleep(10); });
    run.spawn(
        [&] {
          for (int ns = 5; ns < service_ends; ns += 10) run.sleep(ns);
        },
        {.service = true});
    run.spawn(other, [&] { run.sleep(1000); });
    run.scheduler.run_before(Time::max());
    EXPECT_TRUE(run.robot.ended);
    EXPECT_EQ(run.robot.end_time, Time::from_ns(10));
    return run.robot.digest.value();
  };
  EXPECT_EQ(digest(500), digest(900));
}

TEST(Ends, ServicesDoNotKeepTheRunAlive) {
  TaskRun run;
  std::int64_t ticks = 0;
  run.spawn(
      [&] {
        while (run.scheduler.sleep_until(Time::from_ns(++ticks))) {
        }
      },
      {.service = true});
  run.spawn([&] { run.sleep(100); });
  EXPECT_EQ(run.scheduler.run_before(Time::max()), RunState::stopped);
  EXPECT_EQ(run.scheduler.stop_cause(), StopCause::ended);
  EXPECT_NEAR(static_cast<double>(ticks), 100, 1);
}

TEST(Ends, ManyTasksComeAndGoOnFewStacks) {
  TaskRun run;
  run.spawn([&] {
    for (int i = 1; i <= 100'000; ++i) {
      run.scheduler.spawn(
          run.robot, {.stack = StackSize::small}, [](void*) {}, nullptr);
      run.sleep(i);
    }
  });
  EXPECT_EQ(run.scheduler.run_before(Time::max()), RunState::stopped);
  EXPECT_EQ(run.scheduler.events(), 300'002u);
}

// If the guard is a canary, an overflow is detected when the task is next entered, or when its stack is reused.
TEST(EndsDeathTest, ATaskThatOverwroteItsCanaryIsNamed) {
  const auto overwrite_canary = [](bool and_go_on) {
    TaskRun run;
    run.spawn(
        [&] {
          run.sleep(5);
          running->fiber.stack.guard = Guard::canary;
          *reinterpret_cast<std::uint64_t*>(running->fiber.stack.low) = 1;
          if (and_go_on) run.sleep(7);
        },
        {.name = "deep", .stack = StackSize::small});
    run.spawn([&] { run.sleep(9); }, {.name = "other"});
    run.scheduler.run_before(Time::max());
  };
  sanitizer::look();
  const std::string report = std::string("ran over the end of its stack\n.*in task deep of robot.*its stack has ") +
                             (sanitizer::present ? "256" : "16") + " KiB";
  EXPECT_DEATH(overwrite_canary(true), report);
  EXPECT_DEATH(overwrite_canary(false), report);
}

}  // namespace
}  // namespace waitpoint::kernel
