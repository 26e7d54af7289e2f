// SPDX-License-Identifier: BSD-3-Clause
// Reads a whole file, up to a limit of its size.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace waitpoint::world {

/// All bytes of a file. BadInput, naming the file and `expected` ("an image (PGM or PNG)"), if it is missing, no
/// regular file, empty or longer than `bytes_max`.
std::string file_contents(const std::string& file, std::string_view expected, std::size_t bytes_max);

/// Resolves `path`, relative to the folder of `file`.
std::string beside(const std::string& file, const std::string& path);

}  // namespace waitpoint::world
