// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/report/object_names.hpp"

#include <atomic>
#include <string_view>

#include "fibers/kernel/access.hpp"

namespace waitpoint::sync {
namespace {

constexpr std::uint32_t holders_shown = 4;

std::atomic<VariableName> name_of_variable = nullptr;

// Of a word the variables, and parts of them, that are accessed.
std::string variables_in(const kernel::MemoryWord& memory) {
  const VariableName name_of = name_of_variable;
  std::string names;
  for (unsigned byte = 0; byte < 8 && name_of != nullptr; ++byte)
    if ((memory.starts >> byte & 1) != 0)
      if (const char* const name = name_of(reinterpret_cast<const void*>(memory.address + byte)); name != nullptr)
        names.append(names.empty() ? "" : ", ").append(name);
  return names;
}

}  // namespace

std::string describe(const kernel::Task& task) { return std::string(task.name) + " of " + task.robot->name; }

std::string describe(const kernel::Object& object) {
  if (object.kind == std::string_view("function")) return object.label;  // of a call
  std::string text = object.kind;
  text += " #" + std::to_string(object.number);
  const bool is_memory = object.kind == kernel::memory_kind;
  const std::string label = is_memory ? variables_in(static_cast<const kernel::MemoryWord&>(object)) : object.label;
  return label.empty() ? text : text + " \"" + label + "\"";
}

void name_variables_by(VariableName name) { name_of_variable = name; }

std::string describe_holders(const kernel::Object& object) {
  if (object.owner != nullptr) return "held by " + describe(*object.owner);
  std::string text;
  for (std::uint32_t i = 0; i < object.holder_count && i < holders_shown; ++i)
    text += (i == 0 ? "shared by " : ", ") + describe(*object.holders[i]);
  if (object.holder_count > holders_shown)
    text += " and " + std::to_string(object.holder_count - holders_shown) + " more";
  return text;
}

}  // namespace waitpoint::sync
