// SPDX-License-Identifier: BSD-3-Clause
// Small numbers for the names in events, of tasks and objects, in order of their first occurrence as a pair. Equal runs
// have equal numbers.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "core/digest.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/kernel/watch.hpp"

namespace waitpoint::tools {

/// Robot, task and object of an event; the object may be empty.
struct EventName {
  std::string robot, task, object;
  friend bool operator==(const EventName&, const EventName&) = default;
};

inline EventName name_of(const kernel::EventRecord& record) {
  EventName name{record.task->robot->name, record.task->name, ""};
  if (const kernel::Object* object = record.object; object != nullptr) {
    name.object = std::string(object->kind) + "#" + std::to_string(object->number);
    if (object->label[0] != '\0') name.object += std::string(" \"") + object->label + "\"";
  }
  return name;
}

class EventNames {
 public:
  struct Number {
    std::uint32_t number;
    bool is_new;
  };
  Number number_of(const kernel::EventRecord& record) {
    const Key key{record.task->id, record.object == nullptr ? 0 : record.object->identity};
    const auto [at, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(numbers_.size()));
    return {at->second, is_new};
  }

 private:
  struct Key {
    std::uint64_t task, object;
    friend bool operator==(const Key&, const Key&) = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const { return Digest::mix(key.task + Digest::mix(key.object)); }
  };
  std::unordered_map<Key, std::uint32_t, Hash> numbers_;  // lookups only; never iterated
};

}  // namespace waitpoint::tools
