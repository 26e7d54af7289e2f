// SPDX-License-Identifier: BSD-3-Clause
// The file of a program, looked up as a shell does.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

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

/// The dynamic linker that the program names; empty for other files.
std::string interpreter_of(const std::filesystem::path& program);

/// True if a program or library is linked to one whose name begins so.
bool needs_library(const std::filesystem::path& file, std::string_view beginning);

/// True if a program or library makes the system call futex() by itself, or waits by that of libstdc++: the calls that
/// its threads make then do not show how they wait for each other.
bool waits_by_futexes(const std::filesystem::path& file);

/// True if it calls functions that make threads.
bool makes_threads(const std::filesystem::path& file);

/// True if it calls functions of the C library that wait for other threads.
bool waits_by_calls(const std::filesystem::path& file);

}  // namespace waitpoint::tools
