// SPDX-License-Identifier: BSD-3-Clause
// The copy of a program's file that is loaded: see program_image.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::posix {

/// Why it cannot be loaded: "FILE ...", a clause.
using LoadError = char[512];

/// What was taken out of a copy, and is to be done when the program begins and ends: addresses within it, 0 for none.
struct ProgramParts {
  std::uint64_t main = 0, entry = 0;
  std::uint64_t initialise = 0, finish = 0;
  std::uint64_t constructors = 0, constructors_bytes = 0;
  std::uint64_t destructors = 0, destructors_bytes = 0;
};

/// Makes the copy of `file` as a file in memory; its descriptor, or -1 with the reason.
int make_copy(const char* file, ProgramParts& parts, LoadError& error);

}  // namespace waitpoint::posix
