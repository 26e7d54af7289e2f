// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/blocked_report.hpp"

#include <vector>

#include "fibers/sync/object_names.hpp"
#include "fibers/sync/source_lines.hpp"

namespace waitpoint::sync {
namespace {

using kernel::Task;

constexpr std::size_t frames_shown = 4;
constexpr std::size_t tasks_shown = 16;

std::string more(std::size_t count) { return "\n  and " + std::to_string(count) + " more tasks"; }

void add_place(std::string& text, kernel::Scheduler& scheduler, Task& task) {
  void* frames[24];
  const std::size_t count = scheduler.call_stack(task, frames, std::size(frames));
  for (const std::string& line : user_source_lines({frames, count}, frames_shown)) text += "\n      at " + line;
}

// The writer that a reader waits behind, where other readers hold the lock.
const Task* writer_before(const Task& task) {
  if (!task.shared_wait || task.blocked_on->owner != nullptr) return nullptr;
  for (const Task* waiter = task.blocked_on->first_waiter; waiter != nullptr; waiter = waiter->next_waiter)
    if (!waiter->shared_wait) return waiter;
  return nullptr;
}

std::string describe_wait(kernel::Scheduler& scheduler, Task& task) {
  std::string text = "\n  task " + describe(task);
  if (task.blocked_on == nullptr) return text + " is not blocked";
  const kernel::Object& object = *task.blocked_on;
  text += std::string(" waits (") + kernel::name(task.operation) + ") for " + describe(object);
  if (std::string_view(object.kind) == "end of thread" && object.owner != nullptr)
    text += " of " + describe(*object.owner);
  else if (const std::string holders = describe_holders(object); !holders.empty())
    text += ", " + holders;
  if (const Task* writer = writer_before(task); writer != nullptr) text += ", behind " + describe(*writer);
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
      task = task->search.to;
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
    text += "\n  task " + describe(*task) + " (" + kernel::name(task->operation);
    if (task->at != nullptr) text.append(" ").append(describe(*task->at));
    text += ")";
    add_place(text, scheduler, *task);
  }
  if (spinning > tasks_shown) text += more(spinning - tasks_shown);
  return text;
}

}  // namespace waitpoint::sync
