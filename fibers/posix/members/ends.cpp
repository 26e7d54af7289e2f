// SPDX-License-Identifier: BSD-3-Clause
//
// Calls that end a process. If it is several programs, they end only the calling one. Until the last of its threads'
// code was called, the other threads may come first: the calls, and the handlers of the exit, are switch points.
#include <assert.h>
#include <gnu/libc-version.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/files/file_records.hpp"
#include "fibers/posix/links/datagram_medium.hpp"
#include "fibers/posix/members/members.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

/// As a shell reports abort().
constexpr int status_of_abort = 128 + SIGABRT;

bool add_handler(void (*function)(void*), void* argument) {
  auto* const handler = static_cast<ExitHandler*>(std::malloc(sizeof(ExitHandler)));
  if (handler == nullptr) return false;
  Member& member = this_member();
  *handler = {function, argument, member.handlers};
  member.handlers = handler;
  return true;
}

void pass_exit() {
  if (is_simulated()) pass(kernel::Operation::exit, nullptr);
}

/// The C library calls a handler of SIGABRT although it is blocked, up to its release 2.40.
bool abort_unblocks() { return strverscmp(gnu_get_libc_version(), "2.41") < 0; }

/// A handler of the process's exit: most are destructors of static variables.
struct HandlerOfProcess {
  void (*function)(void*);
  void* argument;
};

void call_handler_of_process(void* of) {
  const HandlerOfProcess handler = *static_cast<HandlerOfProcess*>(of);
  std::free(of);
  pass_exit();
  handler.function(handler.argument);
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED void exit(int status) {
  pass_exit();
  if (runs_in_member()) exit_member(status);
  if (family::own != nullptr) family::own->exit_status = status;
  WAITPOINT_NEXT(exit)(status);
  __builtin_unreachable();
}

WAITPOINT_INTERPOSED void quick_exit(int status) noexcept {
  pass_exit();
  if (runs_in_member()) end_member(status);
  if (family::own != nullptr) family::own->exit_status = status;
  WAITPOINT_NEXT(quick_exit)(status);
  __builtin_unreachable();
}

WAITPOINT_INTERPOSED void _exit(int status) {
  pass_exit();
  if (runs_in_member()) end_member(status);
  note_closing_all();
  deliver_datagrams();
  family::leave(W_EXITCODE(status & 0xFF, 0));
  if (instead_of_ending != nullptr) instead_of_ending(status);
  WAITPOINT_NEXT(_exit)(status);
  __builtin_unreachable();
}
WAITPOINT_INTERPOSED void _Exit(int status) noexcept { _exit(status); }

// SIGABRT ends the program though it is blocked or ignored, and a handler can only leave by a jump.
WAITPOINT_INTERPOSED void abort() noexcept {
  pass_exit();
  if (is_simulated()) {
    if (abort_unblocks()) this_thread().blocked &= ~only(SIGABRT);
    const struct sigaction& action = this_program().signals.actions[SIGABRT];
    if ((action.sa_flags & SA_SIGINFO) != 0 || (action.sa_handler != SIG_IGN && action.sa_handler != SIG_DFL))
      raise(SIGABRT);
    if (runs_in_member()) {
      std::fprintf(stderr, "waitpoint: %s is aborted\n", kernel::running->robot->name);
      end_member(status_of_abort);
    }
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

WAITPOINT_INTERPOSED void __assert_fail(const char* condition, const char* file, unsigned line,
                                        const char* function) noexcept {
  if (!runs_in_member()) WAITPOINT_NEXT(__assert_fail)(condition, file, line, function);
  std::fprintf(stderr, "%s: %s:%u: %s%sAssertion `%s' failed.\n", this_member().argv[0], file, line,
               function != nullptr ? function : "", function != nullptr ? ": " : "", condition);
  std::fflush(stderr);
  abort();
}

// Handlers that a program registers are called when it exits; those of its libraries, when the process does. atexit()
// is linked into the program itself, and calls this one.
WAITPOINT_INTERPOSED int __cxa_atexit(void (*function)(void*), void* argument, void* object) {
  if (runs_in_member() && copy_with(this_member().image, object) != nullptr)
    return add_handler(function, argument) ? 0 : -1;
  if (!has_host) {
    if (auto* const handler = static_cast<HandlerOfProcess*>(std::malloc(sizeof(HandlerOfProcess)))) {
      *handler = {function, argument};
      return WAITPOINT_NEXT(__cxa_atexit)(call_handler_of_process, handler, object);
    }
  }
  return WAITPOINT_NEXT(__cxa_atexit)(function, argument, object);
}
