// SPDX-License-Identifier: BSD-3-Clause
// The command line of this process, for a process that carries it out again: with other surroundings, or a library.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::tools {

/// Set in a process that is started with the command line of another one.
inline constexpr const char* layer_variable = "WAITPOINT_PROGRAM_LAYER";
inline constexpr const char* check_variable = "WAITPOINT_CHECK_FILES";  // "LOG,DURATIONS"
/// True there: the other one has printed all notes on the words.
bool repeats_command_line();

/// The words with which this process was started, the program's name first; none: they cannot be read.
std::vector<std::string> own_command_line();

/// For the functions exec: of `words`, which must outlive it, and a null.
std::vector<char*> pointers(const std::vector<std::string>& words);

}  // namespace waitpoint::tools
