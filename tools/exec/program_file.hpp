// SPDX-License-Identifier: BSD-3-Clause
// The file of a program, as a shell would find it.
#pragma once

#include <filesystem>
#include <string>

namespace waitpoint::tools {

/// Whether there is a program of this name: a path, or a name to be looked for in PATH. Its path; empty if there is
/// none.
std::filesystem::path find_program(const std::string& name);

/// Whether it is the path of a shared object that is no program of its own.
bool is_shared_object(const std::filesystem::path& file);

/// Why a library cannot be preloaded into the program, or into what interprets it if it is a script; empty if it can.
std::string cannot_be_simulated(const std::filesystem::path& program);

/// Whether a program that can be simulated is compiled with -fsanitize=thread, and loads the runtime behind that.
bool is_instrumented(const std::filesystem::path& program);

/// Whether a program, or a shared object, is compiled with -fsanitize-coverage=trace-pc or trace-pc-guard, and what it
/// calls then is not in itself.
bool counts_blocks(const std::filesystem::path& program);

}  // namespace waitpoint::tools
