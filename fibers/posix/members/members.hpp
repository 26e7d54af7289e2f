// SPDX-License-Identifier: BSD-3-Clause
// Several programs in one process, each with its own name, arguments, globals and exit status. They share virtual time,
// the objects that have names or keys, and what the C library has once for a process: descriptors, streams, the
// environment, signal handlers.
//
// exit(), _exit(), abort() and the end of the last thread end one of them, with its threads, and not the process.
#pragma once

#include "fibers/posix/members/program_image.hpp"
#include "fibers/posix/program/program_state.hpp"
#include "fibers/posix/program/record.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// What a program has registered to be called when it exits.
struct ExitHandler {
  void (*function)(void*);
  void* argument;
  ExitHandler* next;  ///< registered before
};

struct Member : Program {
  ProgramImage image;
  int argc = 0;
  char** argv = nullptr;
  ExitHandler* handlers = nullptr;  ///< the last first
  bool exiting = false;             ///< a thread is calling the handlers
  bool ended = false;
  int status = 0;
  ProgramRecord* record = nullptr;
};

/// Its first thread, which begins now; false without memory.
bool start(Member& member, kernel::Scheduler& scheduler);
/// Takes away what is left of a member when its run is over, from outside all tasks: nothing of it is called any more.
void drop(Member& member, kernel::Scheduler& scheduler);

/// Whether the running thread is that of a member, in the process in which it began: a child is a process of its own.
bool runs_in_member();
inline Member& this_member() { return static_cast<Member&>(this_program()); }

/// Ends the member of the running thread as exit() would end a process.
[[noreturn]] void exit_member(int status);
/// The same as _exit() would.
[[noreturn]] void end_member(int status);

}  // namespace waitpoint::posix
