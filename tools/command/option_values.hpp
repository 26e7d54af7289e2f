// SPDX-License-Identifier: BSD-3-Clause
// Parsing and validation of option values shared by the commands.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "core/time.hpp"

namespace waitpoint::tools {

/// Throws BadInput: "WHERE: expected EXPECTED, found 'FOUND'".
[[noreturn]] void refuse(const std::string& where, const std::string& expected, const std::string& found);

struct SeedRange {
  std::uint64_t first = 1, last = 1;  ///< inclusive
};

/// A whole number below 2^64; else BadInput.
std::uint64_t seed_of(const std::string& where, const std::string& text);
/// FIRST..LAST, with FIRST <= LAST; else BadInput.
SeedRange seed_range_of(const std::string& where, const std::string& text);

/// From 1 ns to 10^9 s; nothing if `text` is empty; else BadInput.
std::optional<Duration> positive_seconds(const std::string& where, const std::string& text);

/// Throws BadInput, naming both, if one of `others`, options with their values, was given together with `option`.
void check_not_together(const char* option, std::initializer_list<std::pair<const char*, const std::string&>> others);

}  // namespace waitpoint::tools
