// SPDX-License-Identifier: BSD-3-Clause
// "Did you mean": the known name that a misspelt one probably stands for.
//
// Distance: inserted, missing, changed letters and swapped neighbours, one each (optimal string alignment, after
// Damerau, "A technique for computer detection and correction of spelling errors", CACM 1964).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace waitpoint {

/// The least number of edits that make `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The known name nearest to `word`, the first of equals; "" if the distance exceeds a third of the longer word's
/// letters.
std::string nearest_name(std::string_view word, std::span<const std::string_view> known);

/// ", did you mean 'step_ms'?", or "" if no known name is near: the end of a message about an unknown `word`.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> known);

/// The same, or ", expected run, walk or stand" of all known names if none is near.
std::string did_you_mean_or_expected(std::string_view word, std::span<const std::string_view> known);

}  // namespace waitpoint
