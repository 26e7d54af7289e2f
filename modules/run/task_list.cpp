// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/task_list.hpp"

#include "fibers/kernel/run.hpp"

#include <fmt/format.h>

namespace waitpoint::run {
namespace {

const char* state_name(kernel::TaskState state) {
  switch (state) {
    case kernel::TaskState::running: return "running";
    case kernel::TaskState::ready: return "ready";
    case kernel::TaskState::blocked: return "blocked";
    default: return "ended";
  }
}

}  // namespace

std::string list_tasks(const kernel::Scheduler& scheduler, const kernel::Robot& robot) {
  std::string lines;
  for (const kernel::Task* task = kernel::roster(scheduler).first_task(); task != nullptr; task = task->next) {
    if (task->robot != &robot) continue;
    lines += fmt::format("  {:<24} {:<12} {:<8} {} s, {}", task->name, robot.name, state_name(task->state),
                         to_string(task->local_time), kernel::name(task->operation));
    if (const kernel::Object* at = task->blocked_on; at != nullptr)
      lines += fmt::format(" {}#{} {}", at->kind, at->number, at->label);
    lines += "\n";
  }
  return lines;
}

}  // namespace waitpoint::run
