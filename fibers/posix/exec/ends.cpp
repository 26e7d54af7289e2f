// SPDX-License-Identifier: BSD-3-Clause
//
// Calls that end a process. Until the last of its threads' code was called, the other threads may come first: the
// calls, and the handlers of the exit, are switch points.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/links/datagram_medium.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/abort.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

void pass_exit() {
  if (is_simulated()) pass(kernel::Operation::exit, nullptr);
}

void begin_exit(int status) {
  pass_exit();
  if (family::own != nullptr) family::own->exit_status = status;
}

/// A handler of the process's exit: most are destructors of static variables.
struct ExitHandler {
  void (*function)(void*);
  void* argument;
};

void call_handler(void* of) {
  const ExitHandler handler = *static_cast<ExitHandler*>(of);
  std::free(of);
  pass_exit();
  handler.function(handler.argument);
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED void exit(int status) {
  begin_exit(status);
  WAITPOINT_NEXT(exit)(status);
  __builtin_unreachable();
}

WAITPOINT_INTERPOSED void quick_exit(int status) noexcept {
  begin_exit(status);
  WAITPOINT_NEXT(quick_exit)(status);
  __builtin_unreachable();
}

WAITPOINT_INTERPOSED void _exit(int status) {
  pass_exit();
  note_closing_all();
  deliver_datagrams();
  family::leave(W_EXITCODE(status & 0xFF, 0));
  if (instead_of_ending != nullptr) instead_of_ending(status);
  WAITPOINT_NEXT(_exit)(status);
  __builtin_unreachable();
}
WAITPOINT_INTERPOSED void _Exit(int status) noexcept { _exit(status); }

// SIGABRT ends the program though it is blocked or ignored.
WAITPOINT_INTERPOSED void abort() noexcept {
  pass_exit();
  if (is_simulated()) {
    raise_abort();
    do_default(SIGABRT);
  }
  WAITPOINT_NEXT(abort)();
  __builtin_unreachable();
}

// For bugs of the layer: the linker redirects this library's own calls of abort() to it. No handler of the program is
// called.
extern "C" [[noreturn, gnu::visibility("hidden")]] void __wrap_abort() noexcept {
  do_default(SIGABRT);
  WAITPOINT_NEXT(_exit)(status_of_own_errors);
  __builtin_unreachable();
}

// atexit() is linked into the program itself, and calls this one.
WAITPOINT_INTERPOSED int __cxa_atexit(void (*function)(void*), void* argument, void* object) {
  before_call<"atexit">(changing(place::process));
  if (auto* const handler = static_cast<ExitHandler*>(std::malloc(sizeof(ExitHandler)))) {
    *handler = {function, argument};
    return WAITPOINT_NEXT(__cxa_atexit)(call_handler, handler, object);
  }
  return WAITPOINT_NEXT(__cxa_atexit)(function, argument, object);
}
