// SPDX-License-Identifier: BSD-3-Clause
// What the commands' options have in common: how their values are read, and refused.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/time.hpp"

namespace waitpoint::tools {

/// Throws BadInput: "WHERE: expected EXPECTED, found 'FOUND'".
[[noreturn]] void refuse(const std::string& where, const std::string& expected, const std::string& found);

struct SeedRange {
  std::uint64_t first = 1, last = 1;  ///< both run
};

/// A whole number below 2^64. BadInput for all else.
std::uint64_t seed_of(const std::string& where, const std::string& text);
/// FIRST..LAST, with FIRST <= LAST. BadInput for all else.
SeedRange seed_range_of(const std::string& where, const std::string& text);

/// From 1 ns to 10^9 s; nothing where `text` is empty. BadInput for all else.
std::optional<Duration> positive_seconds(const std::string& where, const std::string& text);

}  // namespace waitpoint::tools
