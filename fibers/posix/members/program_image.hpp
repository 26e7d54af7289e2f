// SPDX-License-Identifier: BSD-3-Clause
// A program within a process that is not its own: a shared object with a main().
//
// Each instance is loaded as a private copy, with private copies of its libraries, and so with globals of its own. The
// dynamic linker identifies objects by their file, and every copy is a file in memory, changed so that it can be loaded
// beside others:
//
//   constructors, destructors   are called by the layer, at the program's own beginning and end, libraries first
//   libraries                   are needed by the names of their copies; those that all programs share are not needed
//   its own names first         those of the program, then of its libraries, then of the process
//   names unique to a process   (inline variables of C++) become unique to the program with its libraries
#pragma once

#include "fibers/posix/members/program_copy.hpp"

namespace waitpoint::posix {

using Main = int (*)(int, char**, char**);

struct ProgramImage {
  void* handle = nullptr;         ///< of the dynamic linker
  ObjectCopy* program = nullptr;  ///< behind its libraries
};

/// Loads a copy of `file`; false with the reason in `error`.
bool load(ProgramImage& image, const char* file, LoadError& error);
void unload(ProgramImage& image);

/// In the program's first thread, in place of the C library's start-up: calls the constructors and main(), and returns
/// its result.
int call_main(const ProgramImage& image, int argc, char** argv);
void call_destructors(const ProgramImage& image);
/// True if `address` is in it, or in one of its libraries.
bool contains(const ProgramImage& image, const void* address);

}  // namespace waitpoint::posix
