// SPDX-License-Identifier: BSD-3-Clause
// Tasks that use the kernel's interface directly, without primitives.
#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <string>

#include "fibers/kernel/run.hpp"
#include "fibers/kernel/scheduler.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/tasks.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"

namespace waitpoint::kernel {

/// A scheduler with one robot, whose tasks are functions; they log their actions and times.
class TaskRun {
  std::deque<std::function<void()>> bodies_;  // before the scheduler, which unwinds the remaining tasks

 public:
  explicit TaskRun(Order order = Order::fifo, std::uint64_t seed = 0) : scheduler(order, seed) {
    kernel::add_robot(scheduler, robot, "robot");
  }

  Task& spawn(std::function<void()> body, SpawnOptions options = {}) { return spawn(robot, std::move(body), options); }
  Task& spawn(Robot& of, std::function<void()> body, SpawnOptions options = {}) {
    Task* task = kernel::spawn(
        scheduler, of, options, [](void* body) { (*static_cast<std::function<void()>*>(body))(); },
        &bodies_.emplace_back(std::move(body)));
    EXPECT_NE(task, nullptr);
    return *task;
  }
  void sleep(std::int64_t until_ns) { kernel::sleep_until(scheduler, Time::from_ns(until_ns)); }
  void log(const std::string& what) { trace += what + "@" + std::to_string(kernel::global_time(scheduler).ns()) + " "; }

  Scheduler scheduler;
  Robot robot;
  std::string trace;
};

}  // namespace waitpoint::kernel
