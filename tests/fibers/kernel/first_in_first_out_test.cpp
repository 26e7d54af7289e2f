// SPDX-License-Identifier: BSD-3-Clause
// The default order of the events of one instant.
#include <gtest/gtest.h>

#include <deque>
#include <string>
#include <vector>

#include "fibers/kernel/limits.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "tests/fibers/kernel/task_run.hpp"

namespace waitpoint::kernel {
namespace {

TEST(FirstInFirstOut, IsTheOrderOfInsertionAtOneInstant) {
  TaskRun run;
  for (const char* name : {"a", "b", "c"})
    run.spawn([&run, name] {
      for (int i = 0; i < 2; ++i) {
        run.log(name);
        kernel::yield(run.scheduler);
      }
    });
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_EQ(run.trace, "a@0 b@0 c@0 a@0 b@0 c@0 ");
}

TEST(FirstInFirstOut, ATaskGoesOnThoughOthersTieWithIt) {
  TaskRun run;
  Object object("object");
  for (const char* name : {"a", "b"})
    run.spawn([&, name] {
      for (int i = 0; i < 3; ++i) {
        kernel::waitpoint(run.scheduler, Operation::lock, &object);
        run.log(name);
      }
    });
  kernel::run_before(run.scheduler, Time::max());
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
      kernel::block(run.scheduler, object, Time::max());
      run.log(name);
    });
  };
  for (std::size_t i = 0; i < others; ++i) {
    const std::string name = "r" + std::to_string(i);
    kernel::add_robot(run.scheduler, robots[i], name.c_str());
    first.push_back(spawn(i, name + "-first"));
    second.push_back(spawn(i, name + "-second"));
    expected.append(name).append("-second@5 ").append(name).append("-first@5 ");
  }
  run.spawn([&] {
    run.sleep(5);
    for (std::size_t i = 1; i <= others; ++i) kernel::wake(run.scheduler, *second[i * 17 % others]);
    for (std::size_t i = 1; i <= others; ++i) kernel::wake(run.scheduler, *first[i * 23 % others]);
  });
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_EQ(run.trace, expected);
}

TEST(FirstInFirstOut, ARobotThatPollsForAnotherAtOneInstantLetsItRun) {
  TaskRun run;
  Robot other;
  kernel::add_robot(run.scheduler, other, "other");
  int steps = 0;
  run.spawn([&] {
    while (steps < 3) kernel::yield(run.scheduler);
  });
  run.spawn(other, [&] {
    for (; steps < 3; ++steps) kernel::yield(run.scheduler);
  });
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_EQ(kernel::stop_cause(run.scheduler), StopCause::ended);
}

TEST(FirstInFirstOut, AfterAThousandWaitpointsAtOneInstantTiesGetATurn) {
  TaskRun run;
  Object object("object");
  int passed = 0, seen = -1;
  run.spawn([&] {
    while (seen < 0) {
      kernel::waitpoint(run.scheduler, Operation::try_lock, &object);
      ++passed;
    }
  });
  run.spawn([&] { seen = passed; });
  kernel::run_before(run.scheduler, Time::max());
  EXPECT_EQ(kernel::stop_cause(run.scheduler), StopCause::ended);
  EXPECT_EQ(seen, static_cast<int>(waitpoints_max));
}

}  // namespace
}  // namespace waitpoint::kernel
