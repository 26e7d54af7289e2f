// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/roster.hpp"

#include <cstring>

#include "core/error.hpp"

namespace waitpoint::kernel {

void copy_name(char (&to)[name_size], const char* from) {
  std::strncpy(to, from != nullptr ? from : "", name_size - 1);
  to[name_size - 1] = '\0';
}

void Roster::add(Robot& robot, const char* name, Scheduler& scheduler) {
  robot = Robot();
  copy_name(robot.name, name);
  robot.scheduler = &scheduler;
  robot.digest_in_use = &robot.digest;
  Digest id;
  for (const char* c = name; *c != '\0'; ++c) id.add(static_cast<std::uint64_t>(static_cast<unsigned char>(*c)));
  robot.id = id.value();
  if (last_robot_ != nullptr) robot.number = last_robot_->number + 1;
  put_last(robot);
  (last_robot_ == nullptr ? first_robot_ : last_robot_->next) = &robot;
  last_robot_ = &robot;
}

void Roster::put_last(Robot& robot) {
  robot.place = places_;
  if (places_ < places_max) ++places_;
}

void Roster::add(Task& task) {
  WAITPOINT_CHECK(!is_full(), "a run has more tasks than its bound");
  task.number = made_++;
  task.previous = last_task_;
  (last_task_ == nullptr ? first_task_ : last_task_->next) = &task;
  last_task_ = &task;
  ++tasks_;
  if (!task.service) {
    ++live_tasks_;
    ++task.robot->live_tasks;
  }
}

void Roster::remove(Task& task) {
  WAITPOINT_CHECK(task.state != TaskState::ended, "a task ends twice");
  task.state = TaskState::ended;
  (task.previous == nullptr ? first_task_ : task.previous->next) = task.next;
  (task.next == nullptr ? last_task_ : task.next->previous) = task.previous;
  --tasks_;
}

void Roster::abandon(Task& task) {
  remove(task);
  task.next = first_abandoned_;
  first_abandoned_ = &task;
}

bool Roster::count_end(const Task& task, Time now) {
  if (task.service) return false;
  Robot& robot = *task.robot;
  WAITPOINT_CHECK(robot.live_tasks > 0 && live_tasks_ > 0, "more tasks of a robot end than were made");
  if (--robot.live_tasks == 0) {
    robot.ended = true;
    robot.digest_in_use = &ended_robots_digest_;
    robot.end_time = now;
  }
  return --live_tasks_ == 0;
}

void Roster::restart() {
  WAITPOINT_CHECK(first_task_ == nullptr, "a roster is emptied that has tasks");
  const std::uint32_t most_tasks = most_tasks_;
  *this = Roster();
  most_tasks_ = most_tasks;
}

std::uint64_t Roster::events() const {
  std::uint64_t pairs = ended_robots_digest_.pairs();
  for (const Robot* robot = first_robot_; robot != nullptr; robot = robot->next)
    pairs += robot->digest.pairs() - robot->outputs;
  return pairs;
}

}  // namespace waitpoint::kernel
