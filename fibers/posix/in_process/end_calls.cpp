// SPDX-License-Identifier: BSD-3-Clause
//
// Calls that end a process end the calling program. Until the last of its threads' code was called, the other threads
// may come first: the calls are switch points.
#include <assert.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/in_process/loaded_program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/abort.hpp"

namespace waitpoint::posix {
namespace {

bool add_handler(void (*function)(void*), void* argument) {
  auto* const handler = static_cast<ExitHandler*>(std::malloc(sizeof(ExitHandler)));
  if (handler == nullptr) return false;
  LoadedProgram& program = this_loaded_program();
  *handler = {function, argument, program.handlers};
  program.handlers = handler;
  return true;
}

void pass_exit() {
  if (is_simulated()) pass(kernel::Operation::exit, nullptr);
}

void end_now(int status) {
  pass_exit();
  if (runs_in_loaded_program()) end_program(W_EXITCODE(status & 0xFF, 0));
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED void exit(int status) {
  pass_exit();
  if (runs_in_loaded_program()) exit_program(status);
  WAITPOINT_NEXT(exit)(status);
  __builtin_unreachable();
}
WAITPOINT_INTERPOSED void quick_exit(int status) noexcept {
  end_now(status);
  WAITPOINT_NEXT(quick_exit)(status);
  __builtin_unreachable();
}
WAITPOINT_INTERPOSED void _exit(int status) {
  end_now(status);
  WAITPOINT_NEXT(_exit)(status);
  __builtin_unreachable();
}
WAITPOINT_INTERPOSED void _Exit(int status) noexcept { _exit(status); }

// SIGABRT ends the program though it is blocked or ignored.
WAITPOINT_INTERPOSED void abort() noexcept {
  pass_exit();
  if (is_simulated()) raise_abort();
  if (runs_in_loaded_program()) {
    std::fprintf(stderr, "waitpoint: %s is aborted\n", kernel::running->robot->name);
    end_program(W_EXITCODE(0, SIGABRT));
  }
  WAITPOINT_NEXT(abort)();
  __builtin_unreachable();
}

WAITPOINT_INTERPOSED void __assert_fail(const char* condition, const char* file, unsigned line,
                                        const char* function) noexcept {
  if (!runs_in_loaded_program()) WAITPOINT_NEXT(__assert_fail)(condition, file, line, function);
  std::fprintf(stderr, "%s: %s:%u: %s%sAssertion `%s' failed.\n", this_loaded_program().argv[0], file, line,
               function != nullptr ? function : "", function != nullptr ? ": " : "", condition);
  std::fflush(stderr);
  abort();
}

// Handlers that a program registers are called when it exits; those of its libraries, when the process does. atexit()
// is linked into the program itself, and calls this one.
WAITPOINT_INTERPOSED int __cxa_atexit(void (*function)(void*), void* argument, void* object) {
  if (runs_in_loaded_program() && copy_with(this_loaded_program().image, object) != nullptr)
    return add_handler(function, argument) ? 0 : -1;
  return WAITPOINT_NEXT(__cxa_atexit)(function, argument, object);
}
