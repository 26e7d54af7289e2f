// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/option_values.hpp"

#include <algorithm>
#include <string_view>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "core/word_list.hpp"

namespace waitpoint::tools {
namespace {

std::string bound_text(std::uint64_t bound) { return ~bound == 0 ? "2^64 - 1" : std::to_string(bound); }

std::string whole_text(std::uint64_t low, std::uint64_t high) {
  if (~high == 0 && low == 1) return "a positive whole number";
  if (low == high) return bound_text(low);
  return "a whole number from " + bound_text(low) + " to " + bound_text(high);
}

OptionValue file(std::optional<std::filesystem::path>& into, const char* placeholder, OptionValue::File use) {
  OptionValue value{.placeholder = placeholder, .file = use};
  value.take = [&into](const std::string&, const std::string& text) { into = text; };
  return value;
}

}  // namespace

void refuse(const std::string& where, const std::string& expected, const std::string& found) {
  throw BadInput(where, "expected " + expected + ", found '" + found + "'");
}

OptionValue flag(bool& into) {
  OptionValue value{.is_flag = true};
  value.take = [&into](const std::string&, const std::string&) { into = true; };
  return value;
}

OptionValue text(std::string& into, const char* placeholder) {
  OptionValue value{.placeholder = placeholder};
  value.take = [&into](const std::string&, const std::string& text) { into = text; };
  return value;
}

OptionValue texts(std::vector<std::string>& into, const char* placeholder) {
  OptionValue value{.placeholder = placeholder, .is_repeated = true};
  value.take = [&into](const std::string&, const std::string& text) { into.push_back(text); };
  return value;
}

OptionValue written_file(std::optional<std::filesystem::path>& into, const char* placeholder) {
  return file(into, placeholder, OptionValue::File::written);
}

OptionValue read_file(std::optional<std::filesystem::path>& into, const char* placeholder) {
  return file(into, placeholder, OptionValue::File::read);
}

OptionValue number(double& into, double low, double high, const char* placeholder, const char* expected) {
  OptionValue value{.placeholder = placeholder};
  value.take = [&into, low, high, expected](const std::string& source, const std::string& text) {
    double read = 0;
    if (!parse_number(text, read) || !(read >= low && read <= high)) refuse(source, expected, text);
    into = read;
  };
  return value;
}

OptionValue seconds(std::optional<Duration>& into, const char* placeholder) {
  OptionValue value{.placeholder = placeholder};
  value.take = [&into](const std::string& source, const std::string& text) {
    double read = 0;
    if (!parse_number(text, read) || !(read >= 1e-9 && read <= 1e9))
      refuse(source, "a positive number of seconds", text);
    into = Duration::from_seconds(read);
  };
  return value;
}

OptionValue seed_range(std::optional<SeedRange>& into) {
  OptionValue value{.placeholder = "A..B"};
  value.take = [&into](const std::string& source, const std::string& text) {
    SeedRange range;
    const std::size_t dots = text.find("..");
    const bool is_good = dots != std::string::npos &&
                         parse_number(std::string_view(text).substr(0, dots), range.first) &&
                         parse_number(std::string_view(text).substr(dots + 2), range.last) && range.first <= range.last;
    if (!is_good) refuse(source, "FIRST..LAST", text);
    into = range;
  };
  return value;
}

OptionValue whole_number(std::uint64_t low, std::uint64_t high, const char* placeholder,
                         std::function<void(std::uint64_t)> store) {
  OptionValue value{.placeholder = placeholder};
  value.take = [low, high, store = std::move(store)](const std::string& source, const std::string& text) {
    std::uint64_t read = 0;
    if (!parse_number(text, read) || read < low || read > high) refuse(source, whole_text(low, high), text);
    store(read);
  };
  return value;
}

OptionValue one_of(std::vector<std::string> words, std::function<void(std::size_t)> store) {
  OptionValue value;
  for (const std::string& word : words) value.placeholder += (value.placeholder.empty() ? "" : "|") + word;
  value.words = words;
  value.take = [words = std::move(words), store = std::move(store)](const std::string& source,
                                                                    const std::string& text) {
    const auto found = std::ranges::find(words, text);
    if (found == words.end()) {
      const std::vector<std::string_view> known(words.begin(), words.end());
      throw BadInput(source, "expected " + word_list(known) + ", found '" + text + "'" + did_you_mean(text, known));
    }
    store(static_cast<std::size_t>(found - words.begin()));
  };
  return value;
}

}  // namespace waitpoint::tools
