// SPDX-License-Identifier: BSD-3-Clause
#include "modules/logs/stamp.hpp"

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"

namespace waitpoint::logs {

std::optional<Time> parse_stamp(std::string_view text) {
  constexpr double seconds_max = 4e9;  // differences of two fit a Duration, too
  double seconds = 0;
  if (!parse_number(text, seconds) || !(std::fabs(seconds) < seconds_max)) return std::nullopt;
  const std::size_t point = std::min(text.find('.'), text.size());
  std::int64_t whole = 0;
  if (text.find_first_of("eE") != text.npos || !parse_number(text.substr(0, point), whole))
    return Time() + Duration::from_seconds(seconds);
  std::int64_t ns = 0;
  for (std::size_t i = 1; i <= 9; ++i) ns = 10 * ns + (point + i < text.size() ? text[point + i] - '0' : 0);
  constexpr std::int64_t second = 1'000'000'000;
  return Time::from_ns(whole * second + (text.starts_with('-') ? -ns : ns));
}

}  // namespace waitpoint::logs
