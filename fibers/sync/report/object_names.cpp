// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/report/object_names.hpp"

#include <atomic>
#include <string_view>

#include "fibers/kernel/access.hpp"

namespace waitpoint::sync {
namespace {

constexpr std::uint32_t holders_shown = 4;

std::atomic<VariableName> name_of_variable = nullptr;

std::string_view without_offset(std::string_view name) { return name.substr(0, name.find('+')); }

// Of a word the variables that begin at a multiple of four bytes, and, if there are none, at others.
std::string variables_in(const kernel::Memory& memory) {
  const VariableName name_of = name_of_variable;
  std::string names, latest;
  for (const std::uint64_t offset : {0, 4, 1, 2, 3, 5, 6, 7}) {
    if (offset == 1 && !names.empty()) break;
    const char* const name =
        name_of == nullptr ? nullptr : name_of(reinterpret_cast<const void*>(memory.address + offset));
    if (name == nullptr || without_offset(name) == latest) continue;
    latest = without_offset(name);
    names.append(names.empty() ? "" : ", ").append(name);
  }
  return names;
}

}  // namespace

std::string describe(const kernel::Task& task) { return std::string(task.name) + " of " + task.robot->name; }

std::string describe(const kernel::Object& object) {
  if (object.kind == std::string_view("function")) return object.label;  // of a call
  std::string text = object.kind;
  text += " #" + std::to_string(object.number);
  const bool is_memory = object.kind == kernel::memory_kind;
  const std::string label = is_memory ? variables_in(static_cast<const kernel::Memory&>(object)) : object.label;
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
