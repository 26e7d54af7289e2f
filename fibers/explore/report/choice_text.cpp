// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/report/choice_text.hpp"

#include <utility>

#include "core/error.hpp"
#include "fibers/explore/races/runtime.hpp"
#include "fibers/explore/report/event_words.hpp"
#include "fibers/sync/report/object_names.hpp"

namespace waitpoint::exploration {
namespace {

// Waiters in the kernel's own list have names.
std::string wakes(const Task& task, std::uint32_t chosen, std::uint32_t count) {
  std::uint32_t listed = 0;
  const Task* found = nullptr;
  if (task.at != nullptr)
    for (const Task* waiter = task.at->first_waiter; waiter != nullptr; waiter = waiter->next_waiter)
      if (listed++ == chosen) found = waiter;
  if (found != nullptr && listed == count) return "wakes " + title_of(*found);
  return "wakes waiter " + std::to_string(chosen + 1) + " of " + std::to_string(count);
}

// The names of the memory orders, as compilers number them.
const char* name_of_order(int order) {
  constexpr const char* names[] = {"relaxed", "consume", "acquire", "release", "acq_rel", "seq_cst"};
  return names[order];
}

ChoiceText reads(std::uint32_t newer) {
  WAITPOINT_CHECK(&waitpoint_races_runtime != nullptr, "a load chooses its value without the runtime for it");
  const races::ReadableStore store = waitpoint_races_runtime()->readable_store(newer);
  std::string words = newer == 0 ? "reads the newest value"
                                 : std::string("reads an older value, as C++ allows for ") + name_of_order(store.order);
  words += ": " + std::to_string(store.value);
  if (store.place == 0) return {words + ", the one before the first atomic store"};
  const sync::CodePlace place = sync::code_place_of(reinterpret_cast<const void*>(store.place));
  return {words + ", stored by " + store.task + "#" + std::to_string(store.record - 1), place};
}

}  // namespace

std::string title_of(const Task& task) {
  const std::string title = std::string(task.name) + "#" + std::to_string(task.number);
  return std::string_view(task.robot->name) == "environment" ? title : title + " of " + task.robot->name;
}

std::string about_to(const Task& task) { return title_of(task) + ", about to " + next_event(task); }

std::string next_event(const Task& task) {
  const std::string_view kind = task.at != nullptr ? task.at->kind : "";
  return event_in_words(task.operation, task.sequence, kind, task.at != nullptr ? sync::describe(*task.at) : "");
}

ChoiceText in_words(Choice choice, const Task& task, std::uint32_t chosen, std::uint32_t count) {
  switch (choice) {
    case Choice::waiter: return {wakes(task, chosen, count)};
    case Choice::spurious: return {chosen != 0 ? "wakes up spuriously" : "waits"};
    case Choice::loss: return {chosen != 0 ? "loses the datagram" : "delivers the datagram"};
    case Choice::process: return {chosen != 0 ? "waits for another process" : "or its process goes first"};
    case Choice::value: return reads(chosen);
    default: return {"takes alternative " + std::to_string(chosen) + " of " + std::to_string(count)};
  }
}

}  // namespace waitpoint::exploration
