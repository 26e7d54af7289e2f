// SPDX-License-Identifier: BSD-3-Clause
// A file's bytes, never more of them than can be meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace waitpoint::world {

/// All bytes of a file. BadInput, naming it and what was `expected` ("an image (PGM or PNG)"), if it is missing, no
/// regular file, empty or longer than `bytes_max`.
std::string file_contents(const std::string& file, std::string_view expected, std::size_t bytes_max);

/// The path of a file that `file` names by a path relative to itself.
std::string beside(const std::string& file, const std::string& path);

}  // namespace waitpoint::world
