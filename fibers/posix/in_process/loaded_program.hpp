// SPDX-License-Identifier: BSD-3-Clause
// A program in the process of its host, beside others, each with its own name, arguments, globals, environment, signals
// and exit status. They share virtual time, objects with names or keys, and the C library's state of the process:
// descriptors, streams.
//
// exit(), _exit(), abort() and the end of the last thread end one program with its threads, not the process.
#pragma once

#include "core/error.hpp"
#include "fibers/posix/in_process/program_image.hpp"
#include "fibers/posix/program/program_state.hpp"
#include "fibers/posix/program/record.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// A handler that a program has registered for its exit.
struct ExitHandler {
  void (*function)(void*);
  void* argument;
  ExitHandler* next;  ///< the one registered before it
};

struct LoadedProgram : Program {
  ProgramImage image;
  char label_text[kernel::name_size] = {};
  int argc = 0;
  char** argv = nullptr;            ///< its own, as the words are; with null behind the last
  ExitHandler* handlers = nullptr;  ///< the last one first
  bool exiting = false;             ///< a thread is calling the handlers
  bool ended = false;
  int status = 0;  ///< as of waitpid()
};

/// Loads the program whose file is its first argument, and names it; null with the reason.
LoadedProgram* load(const char* name, int argc, const char* const* argv, LoadError& error);
/// Makes its first thread, which begins now; false without memory.
bool start(LoadedProgram& program, kernel::Scheduler& scheduler);
/// Releases a program with its threads after its run, from outside all tasks. None of its code is called.
void drop(LoadedProgram* program, kernel::Scheduler& scheduler);

/// True if the running thread is one of a program, and in the host's process.
bool runs_in_loaded_program();
inline LoadedProgram& this_loaded_program() {
  WAITPOINT_CHECK(this_program().is_loaded, "the running thread's program is taken for one in the host's process");
  return static_cast<LoadedProgram&>(this_program());
}

/// Ends the running thread's program, as exit() ends a process.
[[noreturn]] void exit_program(int exit_status);
/// The same, as _exit() or a signal does; `status` is as of waitpid().
[[noreturn]] void end_program(int status);

}  // namespace waitpoint::posix
