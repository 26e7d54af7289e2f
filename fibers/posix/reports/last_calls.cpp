// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/reports/last_calls.hpp"

#include <new>
#include <string>
#include <utility>

#include "fibers/kernel/run.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/family/task_names.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/reports/memory.hpp"
#include "fibers/posix/reports/program_calls.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t threads_max = 100;

// Null where there is no memory left.
std::vector<LastCalls>* logged() {
  void* memory = family::common(family::Part::last_calls, 0);
  if (memory == nullptr && (memory = family::common(family::Part::last_calls, sizeof(LastCallsLog))) != nullptr)
    new (memory) LastCallsLog();
  return memory != nullptr ? &static_cast<LastCallsLog*>(memory)->threads : nullptr;
}

std::string name_of(const kernel::Task& task) {
  char name[128];
  BoundedText text(name, sizeof name);
  add_name(text, task);
  return name;
}

// In the handler of the signal, on the stack of the thread.
void log_crash(int signal) {
  static bool is_logging = false;  // a destroyed stack may not be readable
  std::vector<LastCalls>* const all = logged();
  if (all == nullptr || std::exchange(is_logging, true)) return;
  const NewInFamily in_family;
  all->push_back({name_of(*kernel::running) + " is terminated by signal " + std::to_string(signal), running_calls()});
}

}  // namespace

void log_waits(const kernel::Scheduler& scheduler) {
  std::vector<LastCalls>* const all = logged();
  if (all == nullptr) return;
  const NewInFamily in_family;
  for (kernel::Task* task = kernel::first_task(scheduler); task != nullptr && all->size() < threads_max;
       task = task->next)
    all->push_back({name_of(*task), program_calls(*task)});
}

void begin_crash_log() {
  on_crash = log_crash;
  for (SignalSet left = crashes; left != 0; left &= left - 1) install(__builtin_ctzll(left) + 1);
}

}  // namespace waitpoint::posix
