// SPDX-License-Identifier: BSD-3-Clause
// Reads a whole file, up to a limit of its size, and notes it (core/file_list.hpp).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace waitpoint {

/// All bytes of a file that other input names. BadInput, naming the file and `expected` ("an image (PGM or PNG)"), if
/// it is not confined (core/confinement.hpp), missing, no regular file, empty or longer than `bytes_max`.
std::string file_contents(const std::string& file, std::string_view expected, std::size_t bytes_max);

/// All bytes of a file that the user names, which may be a pipe. BadInput if it cannot be read, with the system's
/// reason, is a folder or longer than `bytes_max`.
std::string given_file_contents(const std::filesystem::path& file, std::size_t bytes_max);

}  // namespace waitpoint
