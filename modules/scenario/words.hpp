// SPDX-License-Identifier: BSD-3-Clause
// Splits a command line into words: separated by blanks; double quotes enclose a word with blanks.
#pragma once

#include <string>
#include <string_view>

#include "modules/scenario/location.hpp"

namespace waitpoint::scenario {

/// `text` without leading and trailing blanks.
std::string_view trimmed(std::string_view text);

/// Removes the first word from `text` and returns it without quotes; empty at the end. A missing closing quote is
/// BadInput.
std::string take_word(std::string_view& text, const Location& written);

/// Throws BadInput at `written` if `text` has another word.
void require_end(std::string_view text, const Location& written);

}  // namespace waitpoint::scenario
