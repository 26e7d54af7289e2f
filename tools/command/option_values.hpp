// SPDX-License-Identifier: BSD-3-Clause
// The kinds of values that options have, each with its bounds and the variable that it goes to. A text that is none is
// BadInput: "--jobs: expected a whole number from 1 to 1024, found '0'".
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/time.hpp"
#include "tools/command/option.hpp"

namespace waitpoint::tools {

/// Throws BadInput: "WHERE: expected EXPECTED, found 'FOUND'".
[[noreturn]] void refuse(const std::string& where, const std::string& expected, const std::string& found);

struct SeedRange {
  std::uint64_t first = 1, last = 1;  ///< inclusive
};

/// Without a value: given or not.
OptionValue flag(bool& into);
OptionValue text(std::string& into, const char* placeholder);
/// May be given several times.
OptionValue texts(std::vector<std::string>& into, const char* placeholder);
/// A name of a file, which the command writes or reads.
OptionValue written_file(std::optional<std::filesystem::path>& into, const char* placeholder);
OptionValue read_file(std::optional<std::filesystem::path>& into, const char* placeholder);
/// A number from `low` to `high`; without bounds that matter to a user, with `expected` in the message.
OptionValue number(double& into, double low, double high, const char* placeholder, const char* expected);
/// From 1 ns to 10^9 s.
OptionValue seconds(std::optional<Duration>& into, const char* placeholder = "S");
/// FIRST..LAST, with FIRST <= LAST.
OptionValue seed_range(std::optional<SeedRange>& into);
/// Whole numbers, for the template below.
OptionValue whole_number(std::uint64_t low, std::uint64_t high, const char* placeholder,
                         std::function<void(std::uint64_t)> store);
/// Words, for the template below. `store` gets the index of the word.
OptionValue one_of(std::vector<std::string> words, std::function<void(std::size_t)> store);

/// A whole number from `low` to `high`.
template <std::integral Number>
OptionValue whole(Number& into, Number low, Number high, const char* placeholder = "N") {
  return whole_number(static_cast<std::uint64_t>(low), static_cast<std::uint64_t>(high), placeholder,
                      [&into](std::uint64_t number) { into = static_cast<Number>(number); });
}

/// One of some words, each with its meaning.
template <class Meaning, class Into>
OptionValue word(Into& into, std::vector<std::pair<std::string, Meaning>> meanings) {
  std::vector<std::string> words;
  words.reserve(meanings.size());
  for (const auto& [name, meaning] : meanings) words.push_back(name);
  return one_of(std::move(words),
                [&into, meanings = std::move(meanings)](std::size_t index) { into = meanings[index].second; });
}

}  // namespace waitpoint::tools
