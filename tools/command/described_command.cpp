// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <sstream>

#include "tools/command/described_command.hpp"

namespace waitpoint::tools {
namespace {

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }

/// Arguments and types that are files without being called so.
bool is_file(const std::string& type) {
  constexpr const char* others[] = {"BAG", "FINDING", "LOG", "OTHER", "PLAN"};
  return type.starts_with("FILE") || std::ranges::find(others, type) != std::end(others);
}

}  // namespace

OfferedValues offered_values(const DescribedOption& option) {
  using Files = OfferedValues::Files;
  const bool is_argument = !option.names.front().starts_with('-');
  std::istringstream alternatives(is_argument ? option.names.front() : option.type);
  OfferedValues offered;
  for (std::string type; std::getline(alternatives, type, '|');) {
    if (is_file(type)) offered.files = Files::all;
    if (type == "FOLDER") offered.files = Files::folders;
    if (type == "SCENARIO") offered.files = Files::scenarios;
    if (type == "COMMAND") offered.commands = true;
    const std::string fixed(type.begin(), std::ranges::find_if(type, is_upper));
    if (!fixed.empty() && fixed.front() >= 'a' && fixed.front() <= 'z') offered.words.push_back(fixed);
  }
  return offered;
}

std::string summary_of(const std::string& description) {
  std::string summary = description.substr(0, description.find("\n "));
  std::ranges::replace(summary, '\n', ' ');
  if (summary.ends_with('.') || summary.ends_with(':')) summary.pop_back();
  return summary;
}

}  // namespace waitpoint::tools
