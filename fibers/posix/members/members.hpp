// SPDX-License-Identifier: BSD-3-Clause
// Several programs in one process, each with its own name, arguments, globals, environment, signals and exit status.
// They share virtual time, objects with names or keys, and the C library's state of the process: descriptors, streams.
//
// exit(), _exit(), abort() and the end of the last thread end one program with its threads, not the process.
#pragma once

#include "core/error.hpp"
#include "fibers/posix/members/program_image.hpp"
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

struct Member : Program {
  ProgramImage image;
  int argc = 0;
  char** argv = nullptr;
  ExitHandler* handlers = nullptr;  ///< the last one first
  bool exiting = false;             ///< a thread is calling the handlers
  bool ended = false;
  int status = 0;
};

/// Makes its first thread, which begins now; false without memory.
bool start(Member& member, kernel::Scheduler& scheduler);
/// Releases a member's threads and memory after its run, from outside all tasks. None of its code is called.
void drop(Member& member, kernel::Scheduler& scheduler);

/// True if the running thread belongs to a member and is in the members' process. A child process is a program of its
/// own.
bool runs_in_member();
inline Member& this_member() {
  WAITPOINT_CHECK(this_program().is_member, "the running thread's program is taken for a member");
  return static_cast<Member&>(this_program());
}

/// Ends the running thread's member, as exit() ends a process.
[[noreturn]] void exit_member(int status);
/// The same, as _exit() does.
[[noreturn]] void end_member(int status);

}  // namespace waitpoint::posix
