// SPDX-License-Identifier: BSD-3-Clause
// The default order of the events of one instant.
#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <vector>

#include "fibers/kernel/limits.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "tests/fibers/kernel/task_run.hpp"

namespace waitpoint::kernel {
namespace {

TEST(FirstInFirstOut, IsTheOrderOfInsertionAtOneInstant) {
  TaskRun run;
  for (const char* name : {"a", "b", "c"})
    run.spawn([&run, name] {
      for (int i = 0; i < 2; ++i) {
        run.log(name);
        run.scheduler.yield();
      }
    });
  run.scheduler.run_before(Time::max());
  EXPECT_EQ(run.trace, "a@0 b@0 c@0 a@0 b@0 c@0 ");
}

TEST(FirstInFirstOut, ATaskGoesOnThoughOthersTieWithIt) {
  TaskRun run;
  Object object("object");
  for (const char* name : {"a", "b"})
    run.spawn([&, name] {
      for (int i = 0; i < 3; ++i) {
        run.scheduler.waitpoint(Operation::lock, &object);
        run.log(name);
      }
    });
  run.scheduler.run_before(Time::max());
  EXPECT_EQ(run.trace, "a@0 a@0 a@0 b@0 b@0 b@0 ");
}

TEST(FirstInFirstOut, IsRobotByRobotAtOneInstant) {
  constexpr std::size_t others = 40;  // more than an insertion near the head of the present queue passes
  TaskRun run;
  std::deque<Robot> robots(others);
  std::vector<Task*> first, second;
  Object object("object");
  std::string expected;
  const auto spawn = [&](std::size_t i, const std::string& name) {
    return &run.spawn(robots[i], [&, name] {
      run.scheduler.block(object, Time::max());
      run.log(name);
    });
  };
  for (std::size_t i = 0; i < others; ++i) {
    const std::string name = "r" + std::to_string(i);
    run.scheduler.add(robots[i], name.c_str());
    first.push_back(spawn(i, name + "-first"));
    second.push_back(spawn(i, name + "-second"));
    expected.append(name).append("-second@5 ").append(name).append("-first@5 ");
  }
  run.spawn([&] {
    run.sleep(5);
    for (std::size_t i = 1; i <= others; ++i) run.scheduler.wake(*second[i * 17 % others]);
    for (std::size_t i = 1; i <= others; ++i) run.scheduler.wake(*first[i * 23 % others]);
  });
  run.scheduler.run_before(Time::max());
  EXPECT_EQ(run.trace, expected);
}

TEST(FirstInFirstOut, ARobotThatPollsForAnotherAtOneInstantLetsItRun) {
  TaskRun run;
  Robot other;
  run.scheduler.add(other, "other");
  int steps = 0;
  run.spawn([&] {
    while (steps < 3) run.scheduler.yield();
  });
  run.spawn(other, [&] {
    for (; steps < 3; ++steps) run.scheduler.yield();
  });
  run.scheduler.run_before(Time::max());
  EXPECT_EQ(run.scheduler.stop_cause(), StopCause::ended);
}

TEST(FirstInFirstOut, AfterAThousandWaitpointsAtOneInstantTiesGetATurn) {
  TaskRun run;
  Object object("object");
  int passed = 0, seen = -1;
  run.spawn([&] {
    while (seen < 0) {
      run.scheduler.waitpoint(Operation::try_lock, &object);
      ++passed;
    }
  });
  run.spawn([&] { seen = passed; });
  run.scheduler.run_before(Time::max());
  EXPECT_EQ(run.scheduler.stop_cause(), StopCause::ended);
  EXPECT_EQ(seen, static_cast<int>(waitpoints_max));
}

}  // namespace
}  // namespace waitpoint::kernel
