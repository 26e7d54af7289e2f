// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/option_values.hpp"

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace waitpoint::tools {

void refuse(const std::string& where, const std::string& expected, const std::string& found) {
  throw BadInput(where, "expected " + expected + ", found '" + found + "'");
}

std::uint64_t seed_of(const std::string& where, const std::string& text) {
  std::uint64_t seed = 0;
  if (!parse_number(text, seed)) refuse(where, "a whole number from 0 to 2^64 - 1", text);
  return seed;
}

SeedRange seed_range_of(const std::string& where, const std::string& text) {
  SeedRange range;
  const std::size_t dots = text.find("..");
  const bool good = dots != std::string::npos && parse_number(std::string_view(text).substr(0, dots), range.first) &&
                    parse_number(std::string_view(text).substr(dots + 2), range.last) && range.first <= range.last;
  if (!good) refuse(where, "FIRST..LAST", text);
  return range;
}

std::optional<Duration> positive_seconds(const std::string& where, const std::string& text) {
  if (text.empty()) return std::nullopt;
  double seconds = 0;
  if (!parse_number(text, seconds) || !(seconds >= 1e-9 && seconds <= 1e9))
    refuse(where, "a positive number of seconds", text);
  return Duration::from_seconds(seconds);
}

void check_not_together(const char* option, std::initializer_list<std::pair<const char*, const std::string&>> others) {
  for (const auto& [name, value] : others) {
    if (!value.empty()) throw BadInput(option, std::string("cannot be used together with ") + name);
  }
}

}  // namespace waitpoint::tools
