// SPDX-License-Identifier: BSD-3-Clause
// A line that a person wrote, word by word: blanks between words, double quotes around one that has blanks itself.
#pragma once

#include <string>
#include <string_view>

#include "modules/scenario/location.hpp"

namespace waitpoint::scenario {

/// Without the blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Takes the first word off `text`, without its quotes; empty at the end. A quote that is not closed is BadInput.
std::string take_word(std::string_view& text, const Location& written);

/// Throws BadInput at `written` if there is one more word.
void require_end(std::string_view text, const Location& written);

}  // namespace waitpoint::scenario
