// SPDX-License-Identifier: BSD-3-Clause
// Text from a file, made safe to print within a line.
#pragma once

#include <string>
#include <string_view>

namespace waitpoint {

/// The text with a '?' for each control character (U+0000 to U+001F, U+007F to U+009F), line separator or override of
/// the direction of writing (U+2028 to U+202E, U+2066 to U+2069), and for each byte that is not UTF-8: no line breaks,
/// no terminal escape sequences, no text that looks like another.
std::string printable_line(std::string_view text);

/// True if printable_line() would change nothing.
bool is_printable_line(std::string_view text);

/// The same of a message that quotes input: what stands between single quotes is cut to 80 characters, and the message
/// to 500, so that the wrong file is not printed whole.
std::string printable_message(std::string_view text);

}  // namespace waitpoint
