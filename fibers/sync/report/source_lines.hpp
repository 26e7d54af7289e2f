// SPDX-License-Identifier: BSD-3-Clause
// Return addresses resolved to locations in the user's source.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "fibers/sync/report/code_place.hpp"

namespace waitpoint::sync {

using ReturnAddresses = std::vector<void*>;  ///< of one call stack, innermost first
using CodePlaces = std::vector<CodePlace>;   ///< the same, possibly of a process that has ended

/// For each call stack "function at file:line" of at most `most` innermost frames outside this library and the standard
/// one. Without debugging information, the function's name or the address within its module only. Runs the addr2line
/// program where it is installed, with a time limit; for reports only.
std::vector<std::vector<std::string>> user_source_lines(std::span<const ReturnAddresses> stacks, std::size_t most);
std::vector<std::vector<std::string>> user_source_lines(std::span<const CodePlaces> stacks, std::size_t most);

}  // namespace waitpoint::sync
