// SPDX-License-Identifier: BSD-3-Clause
// The copies of a program's file and of those of its libraries, of which the program is loaded: see program_image.hpp.
#pragma once

#include "fibers/posix/in_process/object_changes.hpp"

namespace waitpoint::posix {

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
  void* handle = nullptr;        ///< of the dynamic linker: of the program, and of libraries that it has opened
  unsigned opens = 0;            ///< references by that handle
  ObjectCopy* before = nullptr;  ///< the one that is initialised before it
};

/// Copies `file` and the libraries that it is linked to, each to a file in memory; returns the program's copy, the
/// last one of the list, or null with the reason.
ObjectCopy* make_copies(const char* file, LoadError& error);
/// The same for a library that the program opens while it runs, which sees the program's names, too: in front of the
/// list whose last copy is `last`.
ObjectCopy* add_copies(ObjectCopy* last, const ObjectCopy& program, const char* file, const char* name,
                       LoadError& error);
/// Closes and frees the copies of a list, up to the one before `end`.
void forget_copies(ObjectCopy* last, const ObjectCopy* end = nullptr);

}  // namespace waitpoint::posix
