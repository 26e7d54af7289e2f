// SPDX-License-Identifier: BSD-3-Clause
// Choices in words that end with a place of code, with its source line. The lines are looked up all at once: for
// reports.
#pragma once

#include <string>
#include <vector>

#include "fibers/explore/report/choice_text.hpp"
#include "fibers/explore/report/narrator.hpp"

namespace waitpoint::exploration {

/// The words, followed by " at " and the place as "function at file:line" if there is one.
std::vector<std::string> with_lines(const std::vector<ChoiceText>& texts);
/// The same choices, with these words.
std::vector<Told> with_lines(std::vector<Told> told);

}  // namespace waitpoint::exploration
