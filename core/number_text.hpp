// SPDX-License-Identifier: BSD-3-Clause
// Numbers read from text: all of the text or nothing, whatever the locale, the same bits from every standard library
// (libc++ 14 has no std::from_chars for doubles). And counts as text.
#pragma once

#include <charconv>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace waitpoint {

/// The double nearest to a decimal like "-2.5e3". False, and `number` as it was, for anything else: a space, a leading
/// '+', hexadecimal digits, "inf", "nan", or a number beyond all doubles.
bool parse_number(std::string_view text, double& number);

/// A decimal integer. False for anything else, or one that the type does not hold; `number` is then as it was.
template <std::integral Integer>
bool parse_number(std::string_view text, Integer& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size();
}

/// "1 task", "2 tasks".
std::string counted(std::uint64_t count, std::string_view of);

}  // namespace waitpoint
