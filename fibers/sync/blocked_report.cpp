// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/blocked_report.hpp"

#include <vector>

#include "fibers/sync/source_lines.hpp"

namespace waitpoint::sync {
namespace {

using kernel::Task;

constexpr std::size_t frames_shown = 4;
constexpr std::size_t tasks_shown = 16;

std::string full_name(const Task& task) { return std::string(task.name) + " of " + task.robot->name; }

std::string describe(const kernel::Object& object) {
  std::string text = object.kind;
  text += " #" + std::to_string(object.number);
  if (object.label[0] != '\0') text += std::string(" \"") + object.label + "\"";
  return text;
}

std::string more(std::size_t count) { return "\n  and " + std::to_string(count) + " more tasks"; }

void add_place(std::string& text, kernel::Scheduler& scheduler, Task& task) {
  void* frames[24];
  const std::size_t count = scheduler.call_stack(task, frames, std::size(frames));
  for (const std::string& line : user_source_lines({frames, count}, frames_shown)) text += "\n      at " + line;
}

std::string describe_wait(kernel::Scheduler& scheduler, Task& task) {
  std::string text = "\n  task " + full_name(task);
  if (task.blocked_on == nullptr) return text + " is not blocked";
  text += std::string(" waits (") + kernel::name(task.operation) + ") for " + describe(*task.blocked_on);
  if (task.blocked_on->owner != nullptr) {
    const bool is_end = std::string_view(task.blocked_on->kind) == "end of thread";
    text += (is_end ? " of " : ", held by ") + full_name(*task.blocked_on->owner);
  }
  add_place(text, scheduler, task);
  return text;
}

}  // namespace

std::string describe_deadlock(kernel::Scheduler& scheduler) {
  std::vector<Task*> waiting;
  if (Task* first = scheduler.culprit(); first != nullptr) {
    Task* task = first;
    do {
      waiting.push_back(task);
      task = task->blocked_on->owner;
    } while (task != first);
  } else {
    for (Task* task = scheduler.first_task(); task != nullptr; task = task->next)
      if (!task->service) waiting.push_back(task);
  }
  std::string text = "deadlock at " + to_string(scheduler.global_time()) + " s: ";
  if (scheduler.culprit() == nullptr)
    text += std::to_string(waiting.size()) + " tasks wait, and nothing is left that could wake them";
  else if (waiting.size() == 1)
    text += "a task waits for itself";
  else
    text += std::to_string(waiting.size()) + " tasks wait for each other";
  for (std::size_t i = 0; i < waiting.size() && i < tasks_shown; ++i) text += describe_wait(scheduler, *waiting[i]);
  if (waiting.size() > tasks_shown) text += more(waiting.size() - tasks_shown);
  return text;
}

std::string describe_spinning(kernel::Scheduler& scheduler) {
  std::string text =
      "no progress: virtual time stands still at " + to_string(scheduler.global_time()) + " s while tasks spin";
  std::size_t spinning = 0;
  for (Task* task = scheduler.first_task(); task != nullptr; task = task->next) {
    if (task->state == kernel::TaskState::blocked || task->local_time != scheduler.global_time()) continue;
    if (++spinning > tasks_shown) continue;
    text += "\n  task " + full_name(*task) + " (" + kernel::name(task->operation);
    if (task->at != nullptr) text.append(" ").append(describe(*task->at));
    text += ")";
    add_place(text, scheduler, *task);
  }
  if (spinning > tasks_shown) text += more(spinning - tasks_shown);
  return text;
}

}  // namespace waitpoint::sync
