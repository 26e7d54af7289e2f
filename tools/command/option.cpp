// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/option.hpp"

#include <algorithm>
#include <sstream>

namespace waitpoint::tools {
namespace {

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

/// Placeholders and arguments that are files without being called so.
bool is_file(const std::string& placeholder) {
  constexpr const char* others[] = {"BAG", "FINDING", "LOG", "OTHER", "PLAN"};
  return placeholder.starts_with("FILE") || std::ranges::find(others, placeholder) != std::end(others);
}

}  // namespace

std::string Option::label() const {
  if (is_argument() || value.is_flag) return name;
  return name + (value.omitted.empty() ? " " + value.placeholder : " [" + value.placeholder + "]");
}

std::string Option::brief() const {
  return details.usual.empty() ? description : description + " (default: " + details.usual + ")";
}

std::string Option::summary() const {
  std::string usual = details.environment == nullptr ? "" : "$" + std::string(details.environment);
  if (!details.usual.empty()) usual += (usual.empty() ? "" : ", or ") + details.usual;
  return usual.empty() ? description : description + " (default: " + usual + ")";
}

OfferedValues offered_values(const Option& option) {
  using Files = OfferedValues::Files;
  std::istringstream alternatives(option.is_argument() ? option.name : option.value.placeholder);
  OfferedValues offered;
  const auto offer = [&](const std::string& word) {
    const std::string fixed(word.begin(), std::ranges::find_if(word, is_upper));
    if (!fixed.empty() && is_lower(fixed.front())) offered.words.push_back(fixed);
  };
  for (std::string placeholder; std::getline(alternatives, placeholder, '|');) {
    if (is_file(placeholder)) offered.files = Files::all;
    if (placeholder == "FOLDER") offered.files = Files::folders;
    if (placeholder == "SCENARIO") offered.files = Files::scenarios;
    if (placeholder == "COMMAND") offered.commands = true;
    if (option.value.words.empty()) offer(placeholder);
  }
  for (const std::string& word : option.value.words) offer(word);
  return offered;
}

}  // namespace waitpoint::tools
