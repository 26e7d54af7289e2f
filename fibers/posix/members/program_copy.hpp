// SPDX-License-Identifier: BSD-3-Clause
// The copy of a program's file that is loaded: see program_image.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

/// The reason for a failure, as a clause: "FILE ...".
using LoadError = char[512];

/// Removed from a copy, and called when the program begins and ends: addresses within it, 0 for none.
struct ProgramParts {
  std::uint64_t main = 0;
  std::uint64_t initialise = 0, finish = 0;
  std::uint64_t constructors = 0, constructors_bytes = 0;
  std::uint64_t destructors = 0, destructors_bytes = 0;
};

/// Copies `file` to a file in memory; returns its descriptor, or -1 with the reason.
int make_copy(const char* file, ProgramParts& parts, LoadError& error);

}  // namespace waitpoint::posix
