// SPDX-License-Identifier: BSD-3-Clause
// A program within a process that is not its own: a shared object with a main().
//
// Each instance is loaded as a private copy, with globals of its own. The dynamic linker identifies objects by their
// file, and every copy is a file in memory, changed so that it can be loaded beside others:
//
//   constructors, destructors   are called by the layer, at the program's own beginning and end
//   its own names first         as in a program: a library's definition of the same name does not take precedence
//   names unique to a process   (inline variables of C++) become unique to the copy
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
  char* base = nullptr;    ///< its load address
  int file = -1;           ///< the copy: open, so that a debugger finds the symbols
  Main main = nullptr;
  void (*initialise)() = nullptr;
  void (*finish)() = nullptr;
  Functions constructors, destructors;
};

/// Loads a copy of `file`; false with the reason in `error`.
bool load(ProgramImage& image, const char* file, LoadError& error);
void unload(ProgramImage& image);

/// In the program's first thread, in place of the C library's start-up: calls the constructors and main(), and returns
/// its result.
int call_main(const ProgramImage& image, int argc, char** argv);
void call_destructors(const ProgramImage& image);
/// True if `address` is in it.
bool contains(const ProgramImage& image, const void* address);

}  // namespace waitpoint::posix
