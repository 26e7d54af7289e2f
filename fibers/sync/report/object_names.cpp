// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/report/object_names.hpp"

#include <string_view>

namespace waitpoint::sync {
namespace {

constexpr std::uint32_t holders_shown = 4;

}  // namespace

std::string describe(const kernel::Task& task) { return std::string(task.name) + " of " + task.robot->name; }

std::string describe(const kernel::Object& object) {
  if (object.kind == std::string_view("function")) return object.label;  // of a call
  std::string text = object.kind;
  text += " #" + std::to_string(object.number);
  if (object.label[0] != '\0') text += std::string(" \"") + object.label + "\"";
  return text;
}

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
