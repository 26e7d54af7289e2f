// SPDX-License-Identifier: BSD-3-Clause
// Descriptions from texts, with included files from a map.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "modules/description/parser.hpp"

namespace waitpoint::description {

using Files = std::map<std::string, std::string>;

inline Description described(const std::string& text, const Files& files = {},
                             const std::vector<std::string>& folders = {}) {
  return parse_description({"demo.gen", text}, folders, [&](const std::string& path) -> std::optional<std::string> {
    const auto found = files.find(path);
    return found == files.end() ? std::nullopt : std::optional(found->second);
  });
}

/// The message of the BadInput that the text is, or "" if it is good.
inline std::string refusal(const std::string& text, const Files& files = {}) {
  try {
    described(text, files);
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

/// A module with the given members of its internal data, and what follows.
inline std::string module_with(const std::string& members, const std::string& rest = "") {
  return "module demo { number: 9000; internal_data: DEMO_STR; };\ntypedef struct DEMO_STR { " + members +
         " } DEMO_STR;\n" + rest;
}

inline const Type& member(const Description& description, std::string_view name) {
  const Field* field = find_field(*description.data, std::string(name));
  EXPECT_NE(field, nullptr) << name;
  return *field->type;
}

}  // namespace waitpoint::description
