// SPDX-License-Identifier: BSD-3-Clause
// Numbers parsed from text: the whole text or nothing, independent of the locale, with the same bits from every
// standard library (libc++ 14 has no std::from_chars for doubles). Also numbers and counts formatted as text.
#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace waitpoint {

/// The double nearest to a decimal such as "-2.5e3". False, with `number` unchanged, for anything else: a space, a
/// leading '+', hexadecimal digits, "inf", "nan", or a number outside the range of double.
bool parse_number(std::string_view text, double& number);

/// A decimal integer. False, with `number` unchanged, for anything else, or outside the type's range.
template <std::integral Integer>
bool parse_number(std::string_view text, Integer& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// The fewest digits that read back as the same number.
template <class Number>
std::string number_text(Number number) {
  char digits[40];
  const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, number);
  return {digits, end.ptr};
}

/// "1 task", "2 tasks".
std::string counted(std::uint64_t count, std::string_view of);

}  // namespace waitpoint
