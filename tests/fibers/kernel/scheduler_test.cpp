// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/visit.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/kernel/watch.hpp"
#include "tests/fibers/kernel/task_run.hpp"

namespace waitpoint::kernel {
namespace {

TEST(Scheduler, RunsEventsInTheOrderOfTheirTimes) {
  TaskRun run;
  for (const int ns : {30, 10, 20})
    run.spawn([&run, ns] {
      run.log("start");
      run.sleep(ns);
      run.log(std::to_string(ns));
    });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
  EXPECT_EQ(kernel::stop_cause(run.scheduler), StopCause::ended);
  EXPECT_EQ(run.trace, "start@0 start@0 start@0 10@10 20@20 30@30 ");
  EXPECT_EQ(kernel::events(run.scheduler), 9u);
}

TEST(Scheduler, PhasesOfOneInstantComeInTheirOrder) {
  for (const Order order : {Order::fifo, Order::seeded}) {
    TaskRun run(order, 4);
    const auto at_five = [&run](const char* name, Phase phase) {
      run.spawn(
          [&run, name] {
            run.sleep(5);
            run.log(name);
          },
          {.name = name, .phase = phase});
    };
    at_five("task", Phase::tasks);
    at_five("world", Phase::world);
    at_five("delivery", Phase::deliveries);
    kernel::run_before(run.scheduler, Time::max());
    EXPECT_EQ(run.trace, "delivery@5 world@5 task@5 ");
  }
}

TEST(Scheduler, ATaskGivesWayToALowerPhaseThatComesUpAtItsInstant) {
  TaskRun run;
  Object object("object");
  run.spawn([&] {
    run.sleep(5);
    run.spawn([&] { run.log("world"); }, {.phase = Phase::world});
    kernel::waitpoint(run.scheduler, Operation::lock, &object);
    run.log("task");
  });
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_EQ(run.trace, "world@5 task@5 ");
}

TEST(Scheduler, AWindowRunsWhatIsBeforeItsEndAndNothingElse) {
  TaskRun run;
  Object object("object");
  run.spawn([&] {
    for (const int ns : {10, 20, 30}) {
      run.sleep(ns);
      run.log("a");
    }
  });
  run.spawn([&] {
    kernel::waitpoint(run.scheduler, Operation::wait, &object);
    kernel::block(run.scheduler, object, Time::from_ns(30));
    run.log("b");
  });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::from_ns(10)), RunState::reached);
  EXPECT_EQ(run.trace, "");
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::from_ns(11)), RunState::reached);
  EXPECT_EQ(run.trace, "a@10 ");
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::from_ns(11)), RunState::reached);
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::from_ns(30)), RunState::reached);
  EXPECT_EQ(run.trace, "a@10 a@20 ");
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::from_ns(31)), RunState::stopped);
  EXPECT_EQ(run.trace, "a@10 a@20 b@30 a@30 ");
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
}

TEST(Scheduler, IsIdleWhenNothingCanRun) {
  TaskRun run;
  Object object("object");
  run.spawn([&] {
    kernel::waitpoint(run.scheduler, Operation::wait, &object);
    kernel::block(run.scheduler, object, Time::max());
    run.log("woken");
  });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::from_ns(1000)), RunState::idle);
  EXPECT_EQ(run.trace, "");
}

TEST(Scheduler, WokenTaskTakesTheGlobalTime) {
  TaskRun run;
  Object object("object");
  run.spawn([&] {
    kernel::waitpoint(run.scheduler, Operation::wait, &object);
    EXPECT_EQ(kernel::block(run.scheduler, object, Time::max()), Wake::woken);
    EXPECT_EQ(running->local_time, Time::from_ns(50));
    EXPECT_EQ(kernel::block(run.scheduler, object, Time::from_ns(60)), Wake::timed_out);
    EXPECT_EQ(running->local_time, Time::from_ns(60));
  });
  run.spawn([&] {
    run.sleep(40);
    compute(*running, Duration::from_ns(10));
    kernel::waitpoint(run.scheduler, Operation::notify_one, &object);
    EXPECT_NE(kernel::wake_one(run.scheduler, object), nullptr);
    EXPECT_EQ(kernel::wake_one(run.scheduler, object), nullptr);
  });
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
  EXPECT_EQ(kernel::global_time(run.scheduler), Time::from_ns(60));
}

TEST(Scheduler, AChildStartsAtItsParentsLocalTime) {
  TaskRun run;
  run.spawn([&] {
    compute(*running, Duration::from_ns(70));
    run.spawn([&] { run.log("child"); });
  });
  run.spawn([&] {
    run.sleep(69);
    run.log("other");
  });
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_EQ(run.trace, "other@69 child@70 ");
}

TEST(Scheduler, IdentityIsTheRobotAndTheCreationPath) {
  const auto ids = [](int others) {
    TaskRun run;
    Robot other;
    kernel::add_robot(run.scheduler, other, "other");
    for (int i = 0; i < others; ++i) run.spawn(other, [] {});
    std::vector<std::uint64_t> found;
    found.push_back(run.spawn([&] { found.push_back(run.spawn([] {}).id); }).id);
    found.push_back(run.spawn([] {}).id);
    kernel::run_before(run.scheduler, Time::max());
    return found;
  };
  const std::vector<std::uint64_t> alone = ids(0);
  EXPECT_EQ(alone.size(), 3u);
  EXPECT_TRUE(alone[0] != alone[1] && alone[0] != alone[2] && alone[1] != alone[2]);
  EXPECT_EQ(ids(5), alone);
}

TEST(Scheduler, ObjectsAreNumberedPerRobotAtFirstUseInARun) {
  Object objects[3] = {Object("o"), Object("o"), Object("o")};
  for (int repeat = 0; repeat < 2; ++repeat) {
    TaskRun run;
    Robot other;
    kernel::add_robot(run.scheduler, other, "other");
    run.spawn([&] {
      kernel::waitpoint(run.scheduler, Operation::lock, &objects[2]);
      kernel::waitpoint(run.scheduler, Operation::lock, &objects[0]);
    });
    run.spawn(other, [&] { kernel::waitpoint(run.scheduler, Operation::lock, &objects[1]); });
    kernel::run_before(run.scheduler, Time::max());
    EXPECT_EQ(objects[2].number, 1u);
    EXPECT_EQ(objects[0].number, 2u);
    EXPECT_EQ(objects[1].number, 1u);
    EXPECT_EQ(objects[1].robot, &other);
  }
}

TEST(Scheduler, AWatchSeesEveryExecutedEventAndChangesNothing) {
  struct Counter : Watch {
    std::vector<Operation> seen;
  };
  const auto run_once = [](Counter* counter) {
    TaskRun run;
    kernel::set_watch(run.scheduler, counter);
    run.spawn([&] {
      run.sleep(5);
      kernel::yield(run.scheduler);
    });
    kernel::run_before(run.scheduler, Time::max());
    return run.robot.digest.value();
  };
  Counter counter;
  counter.event = [](Watch& self, const EventRecord& record) {
    static_cast<Counter&>(self).seen.push_back(record.operation);
  };
  EXPECT_EQ(run_once(&counter), run_once(nullptr));
  EXPECT_EQ(counter.seen, (std::vector{Operation::start, Operation::sleep, Operation::yield, Operation::end}));
}

TEST(Scheduler, AWatchThatATaskSetsSeesTheNextEvent) {
  struct Last : Watch {
    Operation seen = Operation::start;
  };
  Last last;
  last.event = [](Watch& self, const EventRecord& record) { static_cast<Last&>(self).seen = record.operation; };
  TaskRun run;
  Object object("object");
  run.spawn([&] {
    kernel::waitpoint(run.scheduler, Operation::lock, &object);
    kernel::waitpoint(run.scheduler, Operation::unlock, &object);
    kernel::set_watch(run.scheduler, &last);
    kernel::waitpoint(run.scheduler, Operation::try_lock, &object);
    EXPECT_EQ(last.seen, Operation::try_lock);
    kernel::set_watch(run.scheduler, nullptr);
  });
  kernel::run_before(run.scheduler, Time::max());
}

TEST(Scheduler, ErrnoAndExceptionsInFlightAreKeptPerTask) {
  TaskRun run;
  Object object("object");
  std::string trace;
  // Each with its own errno and number of exceptions being handled, handing over to each other.
  for (const int own : {1, 2, 3})
    run.spawn([&run, &object, &trace, own] {
      const std::function<void(int)> within = [&](int depth) {
        if (depth > 0) {
          try {
            throw depth;
          } catch (int) {
            within(depth - 1);
            EXPECT_NE(std::current_exception(), nullptr);
          }
          return;
        }
        for (std::int64_t round = 0; round < 4; ++round) {
          errno = own;
          kernel::waitpoint(run.scheduler, Operation::wait, &object);
          if (kernel::wake_one(run.scheduler, object) == nullptr && round == 3) return;
          kernel::block(run.scheduler, object, Time::from_ns(100 * (round + 1)));
          EXPECT_EQ(errno, own);
          trace += std::to_string(own);
        }
      };
      within(own - 1);
      EXPECT_EQ(std::current_exception(), nullptr);
    });
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_GT(trace.size(), 8u);
}

TEST(Scheduler, SpinningWithoutVirtualTimeIsFoundInEveryOrder) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    TaskRun run(seed == 0 ? Order::fifo : Order::seeded, seed);
    Object object("object");
    bool go_on = true;
    for (int i = 0; i < 3; ++i)
      run.spawn([&] {
        while (go_on && kernel::waitpoint(run.scheduler, Operation::try_lock, &object)) {
        }
      });
    EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
    EXPECT_EQ(kernel::stop_cause(run.scheduler), StopCause::no_progress);
    kernel::unwind(run.scheduler);
    EXPECT_EQ(kernel::first_task(run.scheduler), nullptr);
  }
}

TEST(Scheduler, AStackCanBeReadOfEveryTaskThatIsParked) {
  TaskRun run;
  Object object("object");
  Task& blocked = run.spawn([&] {
    kernel::waitpoint(run.scheduler, Operation::wait, &object);
    kernel::block(run.scheduler, object, Time::from_ns(100));
    run.log("blocked");
  });
  Task& paused = run.spawn([&] {
    run.sleep(50);
    run.log("paused");
  });
  Task& unborn = run.spawn([] {}, {.phase = Phase::tasks});
  kernel::run_before(run.scheduler, Time::from_ns(0));
  void* frames[16];
  EXPECT_EQ(call_stack(unborn, frames, 16), 0u);
  kernel::run_before(run.scheduler, Time::from_ns(20));
  for (int repeat = 0; repeat < 2; ++repeat) {
    EXPECT_GT(call_stack(blocked, frames, 16), 4u);
    EXPECT_GT(call_stack(paused, frames, 16), 4u);
    EXPECT_EQ(call_stack(paused, frames, 2), 2u);
  }
  EXPECT_EQ(kernel::run_before(run.scheduler, Time::max()), RunState::stopped);
  EXPECT_EQ(run.trace, "paused@50 blocked@100 ");
}

TEST(SchedulerDeathTest, MisuseIsABug) {
  TaskRun run;
  run.spawn([&] { EXPECT_DEATH(kernel::run_before(run.scheduler, Time::max()), "called from within a task"); });
  run.spawn([&] { EXPECT_DEATH(kernel::unwind(run.scheduler), "called from within a task"); });
  run.spawn([&] { EXPECT_DEATH(kernel::abandon(), "before the run is over"); });
  kernel::run_before(run.scheduler, Time::max());
  kernel::unwind(run.scheduler);
  EXPECT_DEATH(kernel::run_before(run.scheduler, Time::max()), "after the run is over");
}

// The report of a bug has the time and place in the run.
TEST(SchedulerDeathTest, ABugsReportNamesTimeTaskSeedAndReplay) {
  TaskRun run(Order::seeded, 77);
  kernel::hooks(run.scheduler).replay = "the replay line";
  run.spawn(
      [&] {
        run.sleep(1'500'000'000);
        EXPECT_DEATH(WAITPOINT_CHECK(false, "on purpose"),
                     "on purpose.*\n.*at virtual time 1.500000000 s, in task driver of robot, at its event 2 "
                     "\\(sleep\\), seed 77\n.*replay: the replay line");
      },
      {.name = "driver"});
  kernel::run_before(run.scheduler, Time::max());
}

}  // namespace
}  // namespace waitpoint::kernel
