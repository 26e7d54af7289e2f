// SPDX-License-Identifier: BSD-3-Clause
// Text from a file, made safe to print within a line.
#pragma once

#include <string>
#include <string_view>

namespace waitpoint {

/// The text with each ASCII control character replaced by '?': no line breaks, no terminal escape sequences.
std::string printable_line(std::string_view text);

/// The same of a message that quotes input: what stands between single quotes is cut to 80 characters, and the message
/// to 500, so that the wrong file is not printed whole.
std::string printable_message(std::string_view text);

}  // namespace waitpoint
