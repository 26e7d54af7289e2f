// SPDX-License-Identifier: BSD-3-Clause
// The robots and tasks of a run: two intrusive lists in the order of their making, and the counts of their ends.
#pragma once

#include <cstdint>

#include "core/digest.hpp"
#include "core/time.hpp"
#include "fibers/kernel/limits.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::kernel {

class Roster {
 public:
  /// Adds a robot; the record is initialised here and must outlive the run.
  void add(Robot& robot, const char* name, Scheduler& scheduler);
  /// Puts the robot's events behind those of the others at each instant, in the first-in-first-out order.
  void put_last(Robot& robot);
  /// Adds a task, which has not ended, and numbers it. The roster must not be full.
  void add(Task& task);
  /// Removes `task`: its state is `ended` from now on.
  void remove(Task& task);
  /// Removes `task`, which is abandoned: it stays in the list of first_abandoned().
  void abandon(Task& task);
  /// Counts the end of a task at `now`. The digest of a robot is frozen when its last task but services has ended. True
  /// if no task but services remains in the run.
  bool count_end(const Task& task, Time now);
  /// An empty roster; all tasks must have been removed. The bound on tasks is kept.
  void restart();

  /// The lists, linked by `next`; null: empty.
  Task* first_task() const { return first_task_; }
  Task* last_task() const { return last_task_; }
  Robot* first_robot() const { return first_robot_; }
  const Task* first_abandoned() const { return first_abandoned_; }

  /// The number of tasks that have not ended, and its bound.
  std::uint32_t tasks() const { return tasks_; }
  std::uint32_t most_tasks() const { return most_tasks_; }
  void set_most_tasks(std::uint32_t most) { most_tasks_ = most; }
  bool is_full() const { return tasks_ >= most_tasks_; }
  /// The number of tasks that have not ended and are not services.
  std::uint32_t live_tasks() const { return live_tasks_; }

  /// The number of events of all robots.
  std::uint64_t events() const;
  /// Of these, and of outputs, the number by services of robots whose digest was frozen.
  std::uint64_t pairs_after_ends() const { return ended_robots_digest_.pairs(); }

 private:
  Task* first_task_ = nullptr;
  Task* last_task_ = nullptr;
  Robot* first_robot_ = nullptr;
  Robot* last_robot_ = nullptr;
  Task* first_abandoned_ = nullptr;
  std::uint32_t tasks_ = 0;
  std::uint32_t live_tasks_ = 0;
  std::uint32_t made_ = 0;
  std::uint32_t places_ = 0;  // number of robots' places assigned, up to places_max
  std::uint32_t most_tasks_ = tasks_max;
  PairDigest ended_robots_digest_;  // takes in the events of services of robots whose own digest is frozen
};

}  // namespace waitpoint::kernel
