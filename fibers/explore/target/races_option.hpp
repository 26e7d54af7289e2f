// SPDX-License-Identifier: BSD-3-Clause
// What a campaign does with data races. They are always ranked below other failures: a run that fails otherwise, too,
// is reported for that.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace waitpoint {

enum class Races : std::uint8_t {
  report,  ///< a failure that does not end the campaign: each distinct one is reported, once
  fail,    ///< a failure like others: the first one ends the campaign
  ignore,  ///< no failure
};

inline constexpr const char* races_words = "report, fail or ignore";

/// Nothing for another word.
inline std::optional<Races> races_named(std::string_view word) {
  if (word == "report") return Races::report;
  if (word == "fail") return Races::fail;
  if (word == "ignore") return Races::ignore;
  return std::nullopt;
}

}  // namespace waitpoint
