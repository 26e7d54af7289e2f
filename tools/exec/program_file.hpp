// SPDX-License-Identifier: BSD-3-Clause
// The file of a program, looked up as a shell does.
#pragma once

#include <filesystem>
#include <string>

namespace waitpoint::tools {

/// True if it is the path of a shared object that is not a program.
bool is_shared_object(const std::filesystem::path& file);

/// The reason why no library can be preloaded into the program, or into a script's interpreter; empty if one can.
std::string cannot_be_simulated(const std::filesystem::path& program);

/// True if a program that can be simulated is compiled with -fsanitize=thread and loads the sanitizer's runtime.
bool is_instrumented(const std::filesystem::path& program);

/// True if a program or shared object is compiled with -fsanitize-coverage=trace-pc or trace-pc-guard, and does not
/// define the callbacks itself.
bool counts_blocks(const std::filesystem::path& program);

}  // namespace waitpoint::tools
