// SPDX-License-Identifier: BSD-3-Clause
#include "tools/option_values.hpp"

#include "core/error.hpp"
#include "core/number_text.hpp"

namespace waitpoint::tools {

void refuse(const std::string& where, const std::string& expected, const std::string& found) {
  throw BadInput(where, "expected " + expected + ", found '" + found + "'");
}

std::optional<Duration> positive_seconds(const std::string& where, const std::string& text) {
  if (text.empty()) return std::nullopt;
  double seconds = 0;
  if (!parse_number(text, seconds) || !(seconds >= 1e-9 && seconds <= 1e9))
    refuse(where, "a positive number of seconds", text);
  return Duration::from_seconds(seconds);
}

}  // namespace waitpoint::tools
