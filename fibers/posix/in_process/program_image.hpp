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
//   environ                     is a variable of the program's
#pragma once

#include "fibers/posix/in_process/environment.hpp"
#include "fibers/posix/in_process/program_copy.hpp"

namespace waitpoint::posix {

using Main = int (*)(int, char**, char**);

struct ProgramImage {
  ObjectCopy* program = nullptr;
  ObjectCopy* last = nullptr;  ///< the list of its copies: the program, or a library that it has opened since
  Environment environment;
};

/// Loads a copy of `file`, which stays where `image` is; false with the reason in `error`.
bool load(ProgramImage& image, const char* file, LoadError& error);
void unload(ProgramImage& image);

/// In the program's first thread, in place of the C library's start-up: calls the constructors and main(), and returns
/// its result.
int call_main(const ProgramImage& image, int argc, char** argv);

/// The copy of the library that others are linked to by this name, or that has this file. Null: the program.
ObjectCopy* find_copy(const ProgramImage& image, const char* name);
/// Loads a copy of a library that the program opens, with those that it is linked to; null if it cannot be loaded, or
/// all programs share it. The copies that were added are those up to the one that was the last before.
ObjectCopy* open_library(ProgramImage& image, const char* name, int mode);
/// As dlopen() of a copy.
void* open_copy(ObjectCopy& copy, int mode);
/// As dlclose(), if the handle is a copy's, else false. What the program has opened once is loaded to its end.
bool close_copy(const ProgramImage& image, void* handle);
/// Calls the constructors of copies that were added behind `before`.
void call_constructors(const ProgramImage& image, const ObjectCopy* before, int argc, char** argv);

void call_destructors(const ProgramImage& image);
/// The copy that contains this address; null without one.
const ObjectCopy* copy_with(const ProgramImage& image, const void* address);

}  // namespace waitpoint::posix
