// SPDX-License-Identifier: BSD-3-Clause
// Splits the text of arguments into words as a POSIX shell does, without any expansion.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace waitpoint::ros1 {

/// Words are separated by blanks and line ends. Within '...' all is literal; within "..." a backslash stands before a
/// '"' or backslash; elsewhere it makes the next character literal. False if a quote is not closed, or a backslash is
/// last.
bool split_words(std::string_view text, std::vector<std::string>& words);

}  // namespace waitpoint::ros1
