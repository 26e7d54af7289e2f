// SPDX-License-Identifier: BSD-3-Clause
// A program within a process that is not its own: a shared object with a main(), or a position-independent executable.
//
// Each time it is loaded as a private copy, so that a hundred instances have a hundred times their globals. The dynamic
// linker knows objects by their file, and every copy is a file in memory; in the copy is changed what fits only where
// the object stands alone:
//
//   constructors, destructors   left to us: they belong to the program's own beginning and end
//   its own names first         as in a program: what it defines is not taken from a library that has the same name
//   names unique to a process   (inline variables of C++) become unique to the copy
//   the mark of an executable   taken away: the linker would refuse to load it
#pragma once

#include <cstddef>

#include "fibers/posix/members/program_copy.hpp"

namespace waitpoint::posix {

using Main = int (*)(int, char**, char**);

struct ProgramImage {
  struct Functions {
    char** first = nullptr;
    std::size_t count = 0;
  };

  void* handle = nullptr;  ///< of the dynamic linker
  char* base = nullptr;    ///< where it lies
  int file = -1;           ///< the copy: open, so that a debugger finds the symbols
  Main main = nullptr;     ///< of a shared object
  void* entry = nullptr;   ///< of an executable: where the system would begin
  void (*initialise)() = nullptr;
  void (*finish)() = nullptr;
  Functions constructors, destructors;
};

/// Loads a copy of `file`; false with the reason in `error`.
bool load(ProgramImage& image, const char* file, LoadError& error);
void unload(ProgramImage& image);

/// In the program's first thread, in place of what the C library does around main(): the constructors, and what main()
/// returns. An executable calls __libc_start_main() with its main(): the call never comes back.
int call_main(const ProgramImage& image, int argc, char** argv);
/// The same, for the main() that an executable's entry gave.
int call_main(const ProgramImage& image, Main main, int argc, char** argv);
void call_destructors(const ProgramImage& image);
/// Whether `address` lies in it.
bool contains(const ProgramImage& image, const void* address);

}  // namespace waitpoint::posix
