// SPDX-License-Identifier: BSD-3-Clause
// The ends of tasks, and of a run before them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/tasks.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "tests/fibers/kernel/task_run.hpp"

namespace waitpoint::kernel {
namespace {

// If the run ends while a task yields to its ties, unwinding it must not run another task.
TEST(Ends, UnwindingFromAGivenTurnRunsNoOtherTask) {
  TaskRun run;
  Object object("object");
  run.spawn([&] {
    for (std::uint32_t k = 0; k <= waitpoints_max; ++k) kernel::waitpoint(run.scheduler, Operation::try_lock, &object);
    run.log("first");
  });
  run.spawn([&] {
    run.spawn([&] { run.log(kernel::is_unwinding(run.scheduler) ? "unborn" : "world"); }, {.phase = Phase::world});
    run.log("stop");
    kernel::stop(run.scheduler, StopCause::requested);
  });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
  EXPECT_EQ(kernel::stop_cause(run.scheduler), StopCause::requested);
  kernel::unwind(run.scheduler);
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
        kernel::enter(object);
        kernel::block(run.scheduler, object, deadline);
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
        kernel::end_in_place(*other);
        kernel::free_stack(*other);
      }
      EXPECT_EQ(kernel::wake_one(run.scheduler, object), nullptr);
      EXPECT_EQ(kernel::roster(run.scheduler).tasks(), 1u);
      run.sleep(200);
      run.log("alone");
    });
    EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
    EXPECT_EQ(kernel::stop_cause(run.scheduler), StopCause::ended);
    EXPECT_EQ(run.trace, "alone@200 ");
  }
}

TEST(Ends, ATaskEndsWhereItIs) {
  TaskRun run;
  run.spawn([&] {
    kernel::waitpoint(run.scheduler, Operation::end, nullptr);
    kernel::end_running_task();
  });
  run.spawn([&] { run.log("the other"); });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
  EXPECT_EQ(kernel::stop_cause(run.scheduler), StopCause::ended);
  EXPECT_EQ(run.trace, "the other@0 ");
}

TEST(Ends, TheYoungestTaskIsUnwoundFirst) {
  TaskRun run;
  Object object("object");
  for (const char* name : {"parent", "child", "grandchild"})
    run.spawn([&run, &object, name] {
      EXPECT_EQ(kernel::block(run.scheduler, object, Time::max()), Wake::unwinding);
      run.log(name);
    });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::idle);
  kernel::unwind(run.scheduler);
  EXPECT_EQ(run.trace, "grandchild@0 child@0 parent@0 ");
}

TEST(Ends, ATaskThatGoesOnAfterTheEndIsAbandoned) {
  TaskRun run;
  Object object("object");
  run.spawn(
      [&] {
        for (;;) {
          compute(*running, Duration::from_ns(1));
          kernel::waitpoint(run.scheduler, Operation::release, &object);
        }
      },
      {.name = "endless"});
  run.spawn([&] { run.log(kernel::sleep_until(run.scheduler, Time::from_ns(1000)) ? "slept" : "left"); });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::from_ns(500)), RunState::reached);
  kernel::unwind(run.scheduler);
  EXPECT_EQ(run.trace, "left@499 ");
  ASSERT_NE(kernel::roster(run.scheduler).first_abandoned(), nullptr);
  EXPECT_STREQ(kernel::roster(run.scheduler).first_abandoned()->name, "endless");
  EXPECT_EQ(kernel::roster(run.scheduler).first_abandoned()->next, nullptr);
  EXPECT_EQ(kernel::first_task(run.scheduler), nullptr);
}

TEST(Ends, TheDigestOfARobotIsFrozenWhenItsLastTaskEnds) {
  const auto digest = [](int service_ends) {
    TaskRun run;
    Robot other;
    kernel::add_robot(run.scheduler, other, "other");
    run.spawn([&] { run.sleep(10); });
    run.spawn(
        [&] {
          for (int ns = 5; ns < service_ends; ns += 10) run.sleep(ns);
        },
        {.service = true});
    run.spawn(other, [&] { run.sleep(1000); });
    kernel::run_before(run.scheduler, Time::max());
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
        while (kernel::sleep_until(run.scheduler, Time::from_ns(++ticks))) {
        }
      },
      {.service = true});
  run.spawn([&] { run.sleep(100); });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
  EXPECT_EQ(kernel::stop_cause(run.scheduler), StopCause::ended);
  EXPECT_NEAR(static_cast<double>(ticks), 100, 1);
}

TEST(Ends, ManyTasksComeAndGoOnFewStacks) {
  TaskRun run;
  run.spawn([&] {
    for (int i = 1; i <= 100'000; ++i) {
      kernel::spawn(
          run.scheduler, run.robot, {.stack = StackSize::small}, [](void*) {}, nullptr);
      run.sleep(i);
    }
  });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
  EXPECT_EQ(kernel::events(run.scheduler), 300'002u);
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
    kernel::run_before(run.scheduler, Time::max());
  };
  sanitizer::look();
  const std::string report = std::string("ran over the end of its stack\n.*in task deep of robot.*its stack has ") +
                             (sanitizer::present ? "256" : "16") + " KiB";
  EXPECT_DEATH(overwrite_canary(true), report);
  EXPECT_DEATH(overwrite_canary(false), report);
}

}  // namespace
}  // namespace waitpoint::kernel
