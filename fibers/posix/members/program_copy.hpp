// SPDX-License-Identifier: BSD-3-Clause
// The copies of a program's file and of those of its libraries, of which the program is loaded: see program_image.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/posix/members/object_file.hpp"

namespace waitpoint::posix {

/// Removed from a copy, and called when the program begins and ends: addresses within it, 0 for none.
struct ProgramParts {
  std::uint64_t main = 0;
  std::uint64_t initialise = 0, finish = 0;
  std::uint64_t constructors = 0, constructors_bytes = 0;
  std::uint64_t destructors = 0, destructors_bytes = 0;
};

/// The name by which the dynamic linker opens a copy.
struct CopyPath {
  char text[48] = {};
};

struct ObjectCopy {
  char* file = nullptr;  ///< the file copied
  char* name = nullptr;  ///< by which others are linked to it; the program's file
  int descriptor = -1;   ///< of the copy: open, so that a debugger finds the symbols
  CopyPath path;
  ProgramParts parts;
  char* base = nullptr;          ///< its load address
  ObjectCopy* before = nullptr;  ///< the one that is initialised before it
};

/// Copies `file` and the libraries that it is linked to, each to a file in memory; returns the program's copy, the
/// last one of the list, or null with the reason.
ObjectCopy* make_copies(const char* file, LoadError& error);
/// Closes and frees the copies of a list.
void forget_copies(ObjectCopy* last);

}  // namespace waitpoint::posix
