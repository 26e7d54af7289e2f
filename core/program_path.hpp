// SPDX-License-Identifier: BSD-3-Clause
// The file of a program, looked up as a shell does.
#pragma once

#include <filesystem>
#include <string>

namespace waitpoint {

/// True for a regular file that may be executed.
bool is_program(const std::filesystem::path& path);
/// The path of the program of this name, which is a path or is searched in PATH; empty if there is none.
std::filesystem::path find_program(const std::string& name);

}  // namespace waitpoint
