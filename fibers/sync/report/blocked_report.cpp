// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/report/blocked_report.hpp"

#include <algorithm>
#include <vector>

#include "core/number_text.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/run_window.hpp"
#include "fibers/kernel/visit.hpp"
#include "fibers/sync/report/object_names.hpp"
#include "fibers/sync/report/source_lines.hpp"

namespace waitpoint::sync {
namespace {

using kernel::Task;

constexpr std::size_t frames_shown = 4;
constexpr std::size_t tasks_shown = 16;
constexpr std::size_t frames_searched = 24;

// A line for each task, the first few of them, followed by its source locations.
template <class Describe>
std::string describe_each(const std::vector<Task*>& tasks, Places told, Describe describe_one) {
  const std::size_t shown = std::min(tasks.size(), tasks_shown);
  std::vector<ReturnAddresses> stacks;
  for (std::size_t i = 0; i < shown && told == Places::told; ++i) {
    ReturnAddresses& stack = stacks.emplace_back(frames_searched);
    stack.resize(kernel::call_stack(*tasks[i], stack.data(), stack.size()));
  }
  const auto places = user_source_lines(stacks, frames_shown);
  std::string text;
  for (std::size_t i = 0; i < shown; ++i) {
    text += "\n  task " + describe_one(*tasks[i]);
    if (told == Places::left_out) continue;
    for (const std::string& line : places[i]) text += "\n      at " + line;
  }
  if (tasks.size() > shown) text += "\n  and " + counted(tasks.size() - shown, "more task");
  return text;
}

// The waiting writer that blocks this reader, where other readers hold the lock.
const Task* writer_before(const Task& task) {
  if (!task.shared_wait || task.blocked_on->owner != nullptr) return nullptr;
  for (const Task* waiter = task.blocked_on->first_waiter; waiter != nullptr; waiter = waiter->next_waiter)
    if (!waiter->shared_wait) return waiter;
  return nullptr;
}

std::string describe_wait(const Task& task) {
  std::string text = describe(task);
  if (task.blocked_on == nullptr) return text + " is not blocked";
  const kernel::Object& object = *task.blocked_on;
  text += std::string(" waits (") + kernel::name(task.operation) + ") for " + describe(object);
  if (std::string_view(object.kind) == "end of thread" && object.owner != nullptr)
    text += " of " + describe(*object.owner);
  else if (const std::string holders = describe_holders(object); !holders.empty())
    text += ", " + holders;
  if (const Task* writer = writer_before(task); writer != nullptr) text += ", queued behind " + describe(*writer);
  return text;
}

std::string describe_use(const Task& task) {
  std::string text = describe(task) + " (" + kernel::name(task.operation);
  if (task.at != nullptr) text.append(" ").append(describe(*task.at));
  return text + ")";
}

}  // namespace

std::string describe_deadlock(kernel::Scheduler& scheduler, Places places) {
  std::vector<Task*> waiting;
  if (Task* first = kernel::culprit(scheduler); first != nullptr) {
    Task* task = first;
    do {
      waiting.push_back(task);
      task = task->search.to;
    } while (task != first);
  } else {
    for (Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next)
      if (!task->service) waiting.push_back(task);
  }
  std::string text = "deadlock at " + to_string(kernel::global_time(scheduler)) + " s: ";
  if (kernel::culprit(scheduler) != nullptr && waiting.size() == 1)
    text += "a task waits for itself";
  else if (waiting.size() == 1)
    text += "a task is blocked, and no event can wake it";
  else if (kernel::culprit(scheduler) != nullptr)
    text += counted(waiting.size(), "task") + " wait for each other";
  else
    text += counted(waiting.size(), "task") + " are blocked, and no event can wake them";
  return text + describe_each(waiting, places, describe_wait);
}

std::string describe_idle(kernel::Scheduler& scheduler, Time since, Places places) {
  std::vector<Task*> idle;
  for (Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next) {
    const bool waits = task->state == kernel::TaskState::blocked && !task->finite_wait && task->local_time <= since;
    if (waits && (!task->service || task->work.what != nullptr)) idle.push_back(task);
  }
  return describe_each(idle, places, [](const Task& task) {
    std::string text = describe_wait(task) + ", since " + to_string(task.local_time) + " s";
    if (task.work.what != nullptr) text += std::string(", in ") + task.work.what + " of " + task.work.of;
    return text;
  });
}

std::string describe_spinning(kernel::Scheduler& scheduler, Places places) {
  const std::string text =
      "no progress: virtual time stands still at " + to_string(kernel::global_time(scheduler)) + " s while ";
  if (const Task* culprit = kernel::culprit(scheduler); (culprit->attention & kernel::attention::timer) != 0)
    return text + "timers fire without end, the last one " + describe(*culprit->at) + " of " + culprit->robot->name;
  // Of tasks that exchange something, some are blocked at any moment.
  const bool exchange = kernel::is_beyond_instant_limit(scheduler);
  std::vector<Task*> spinning;
  for (Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next)
    if ((exchange || task->state != kernel::TaskState::blocked) && task->local_time == kernel::global_time(scheduler))
      spinning.push_back(task);
  const std::string what =
      exchange ? "tasks pass more waitpoints than the limit of an instant (WAITPOINT_INSTANT_LIMIT)" : "tasks spin";
  return text + what + describe_each(spinning, places, describe_use);
}

std::string describe_endless(kernel::Scheduler& scheduler, Places places) {
  std::vector<Task*> asleep;
  for (Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next)
    if (task->state == kernel::TaskState::ready && task->local_time == Time::max()) asleep.push_back(task);
  return "virtual time ran out" +
         describe_each(asleep, places, [](const Task& task) { return describe(task) + " sleeps without end"; });
}

}  // namespace waitpoint::sync
