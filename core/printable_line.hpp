// SPDX-License-Identifier: BSD-3-Clause
// Text from a file, made safe to print within a line.
#pragma once

#include <string>
#include <string_view>

namespace waitpoint {

/// The text with each ASCII control character replaced by '?': no line breaks, no terminal escape sequences.
std::string printable_line(std::string_view text);

}  // namespace waitpoint
