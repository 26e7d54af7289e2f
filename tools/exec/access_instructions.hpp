// SPDX-License-Identifier: BSD-3-Clause
// The instructions of a program's or library's file that access memory, found by disassembling it.
#pragma once

#include <filesystem>
#include <vector>

#include "fibers/posix/traps/access_instruction.hpp"

namespace waitpoint::tools {

/// False in a build without a disassembler.
bool has_disassembler();

/// In the order of their places, as of module number `module`; without those that push, pop, call, jump and compare
/// strings, and those of thread-local variables. Functions are told apart by the symbols; without symbols the code is
/// one piece. Empty for a file that is no program or library for x86-64.
std::vector<posix::AccessInstruction> access_instructions(const std::filesystem::path& file, std::size_t module = 0);

}  // namespace waitpoint::tools
