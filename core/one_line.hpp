// SPDX-License-Identifier: BSD-3-Clause
// What stood in a file, fit to be shown to a person within a line.
#pragma once

#include <string>
#include <string_view>

namespace waitpoint {

/// The text with each control character (of ASCII) as '?': it ends no line, and a terminal obeys nothing in it.
std::string one_line(std::string_view text);

}  // namespace waitpoint
