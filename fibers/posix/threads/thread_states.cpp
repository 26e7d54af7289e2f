// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/threads/thread_states.hpp"

#include <cstring>

#include "fibers/kernel/run.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/partners.hpp"
#include "fibers/posix/family/task_names.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waitable.hpp"

namespace waitpoint::posix {
namespace {

// "descriptor 3", or "descriptor 3, 4, 7".
void add_descriptors(BoundedText& text, const kernel::Task& task) {
  nfds_t count = 0;
  const pollfd* const awaited = awaited_descriptors(task, count);
  constexpr nfds_t told_max = 8;
  text.add("descriptor");
  for (nfds_t i = 0; i < count && i < told_max; ++i)
    text.add("%s %d%s", i > 0 ? "," : "", awaited[i].fd,
             partner_at(awaited[i].fd) == Partner::none ? "" : " (outside)");
  if (count > told_max) text.add(", ...");
}

void add_object(BoundedText& text, const kernel::Object& object, const kernel::Task& waiter) {
  const Waitable* const waitable = waitable_of(object);
  if (waitable == nullptr) {
    if (std::strcmp(object.kind, "descriptor") == 0) return add_descriptors(text, waiter);
    return text.add("%s", std::strcmp(object.kind, "thread") == 0 ? "the end of a thread" : object.kind);
  }
  add_waitable(text, *waitable);
}

void add_wait(BoundedText& text, const kernel::Task& task) {
  text.add(" waits for ");
  add_object(text, *task.blocked_on, task);
  if (const kernel::Task* owner = task.blocked_on->owner; owner != nullptr) {
    const bool is_end = std::strcmp(task.blocked_on->kind, "thread") == 0;
    text.add(", %s ", is_end ? "that is" : "held by");
    owner == &task ? text.add("itself") : add_name(text, *owner);
  }
  if (task.finite_wait) text.add(", with a timeout");
}

}  // namespace

void add_time(BoundedText& text, Time time) {
  constexpr long long second_ns = 1'000'000'000;
  const long long ns = time.ns();
  text.add("%lld.%09lld s of virtual time", ns / second_ns, ns % second_ns);
}

void add_state(BoundedText& text, const kernel::Task& task) {
  text.add("  ");
  add_name(text, task);
  if (task.blocked_on != nullptr && std::strcmp(task.blocked_on->kind, "sleep") == 0) {
    text.add(" sleeps");
  } else if (task.blocked_on != nullptr) {
    add_wait(text, task);
  } else if (&task == kernel::running) {
    text.add(" computes");
  } else if (task.operation == kernel::Operation::sleep && task.local_time > kernel::global_time(*task.scheduler)) {
    text.add(" sleeps until ");
    add_time(text, task.local_time);
  } else {
    text.add(" is ready");
  }
  text.add("\n");
}

void add_states(BoundedText& text, const kernel::Scheduler& scheduler) {
  for (const kernel::Task* task = kernel::first_task(scheduler); task != nullptr; task = task->next)
    if (is_thread(*task)) add_state(text, *task);
}

}  // namespace waitpoint::posix
