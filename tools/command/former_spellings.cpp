// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/former_spellings.hpp"

#include <algorithm>
#include <cstdio>

#include "core/error.hpp"
#include "tools/command/own_command_line.hpp"

namespace waitpoint::tools {
namespace {

void tell(const std::string& former, const std::string& today) {
  if (repeats_command_line()) return;
  std::fprintf(stderr, "waitpoint: '%s' is now '%s'; the next version knows only that\n", former.c_str(),
               today.c_str());
}

/// The option of this name, or of this former name.
const Option* option_named(const Command& command, const std::string& name) {
  const auto is_named = [&](const Option& option) {
    return option.name == name || (option.details.former != nullptr && option.details.former == name);
  };
  const auto found = std::ranges::find_if(command.options, is_named);
  return found == command.options.end() ? nullptr : &*found;
}

/// Today's value for a former one; else the same.
std::string todays_value(const Option& option, const std::string& value) {
  for (const auto& [former, today] : option.details.former_values)
    if (value == former) {
      tell(option.name + " " + former, option.name + " " + today);
      return today;
    }
  return value;
}

}  // namespace

void replace_former_command(std::vector<std::string>& words,
                            const std::vector<std::pair<std::string, std::string>>& former) {
  const auto word = std::ranges::find_if(words, [](const std::string& text) { return !text.starts_with('-'); });
  if (word == words.end()) return;
  for (const auto& [name, today] : former)
    if (*word == name) {
      tell(name, today);
      *word = today;
      return;
    }
}

void replace_former_spellings(std::vector<std::string>& words, const Command& command) {
  for (auto word = words.begin(); word != words.end() && *word != "--";) {
    if (std::ranges::find(command.former_flags, *word) != command.former_flags.end()) {
      if (!repeats_command_line())
        std::fprintf(stderr, "waitpoint: '%s' is not needed; the next version does not know it\n", word->c_str());
      word = words.erase(word);
      continue;
    }
    const std::string name = word->substr(0, word->find('='));
    if (const auto removed = std::ranges::find(command.removed, name, &RemovedOption::name);
        removed != command.removed.end())
      throw BadInput(name, "was removed: " + removed->instead);
    const Option* const option = option_named(command, name);
    if (option == nullptr) {
      ++word;
      continue;
    }
    if (!word->starts_with(option->name + "=") && *word != option->name) {
      tell(option->details.former, option->name);
      word->replace(0, std::string(option->details.former).size(), option->name);
    }
    if (const std::size_t begin = word->find('='); begin != std::string::npos) {
      *word = option->name + "=" + todays_value(*option, word->substr(begin + 1));
    } else if (!option->value.is_flag && option->value.omitted.empty() && word + 1 != words.end() && word[1] != "--") {
      ++word;
      *word = todays_value(*option, *word);
    }
    ++word;
  }
}

}  // namespace waitpoint::tools
