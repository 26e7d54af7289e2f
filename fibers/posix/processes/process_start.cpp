// SPDX-License-Identifier: BSD-3-Clause
//
// Programs that this one starts. They inherit the signal mask of the starting thread, which the system does not know.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/pace.hpp"
#include "fibers/posix/processes/started_programs.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

/// While it lives, the system has the running thread's mask.
class RealMask {
 public:
  RealMask() {
    const sigset_t blocked = to_sigset(is_simulated() ? this_thread().blocked : 0);
    WAITPOINT_NEXT(pthread_sigmask)(SIG_SETMASK, &blocked, &before_);
  }
  ~RealMask() {
    const ErrorNumberKept kept;
    WAITPOINT_NEXT(pthread_sigmask)(SIG_SETMASK, &before_, nullptr);
  }
  RealMask(const RealMask&) = delete;
  RealMask& operator=(const RealMask&) = delete;

 private:
  sigset_t before_;
};

/// The arguments of execl() and the like, up to the terminating null.
class Words {
 public:
  Words(const char* first, va_list more) {
    va_list counted;
    va_copy(counted, more);
    std::size_t count = 1;
    while (va_arg(counted, char*) != nullptr) ++count;
    va_end(counted);
    words_ = static_cast<char**>(std::malloc((count + 1) * sizeof(char*)));
    if (words_ == nullptr) return;
    words_[0] = const_cast<char*>(first);
    for (std::size_t i = 1; i <= count; ++i) words_[i] = va_arg(more, char*);
  }
  ~Words() { std::free(words_); }
  Words(const Words&) = delete;
  Words& operator=(const Words&) = delete;
  char* const* get() const { return words_; }

 private:
  char** words_;
};

int note_started(int error, const pid_t* child) {
  if (error == 0 && child != nullptr && is_simulated()) note_child(*child);
  return error;
}

void before_start(const posix_spawn_file_actions_t* actions) {
  if (!is_simulated()) return;
  pass(kernel::Operation::start, nullptr);
  // File actions may pass any descriptor to it.
  actions != nullptr ? note_fork() : note_start();
  signals_of_program.ever_blocked |= only(SIGCHLD);
  install(SIGCHLD);
}

// system() ignores SIGINT and SIGQUIT while the shell runs, and blocks SIGCHLD.
int run_shell(const char* command) {
  struct sigaction ignore {
  }, interrupt{}, quit{};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGINT, &ignore, &interrupt);
  sigaction(SIGQUIT, &ignore, &quit);
  const SignalSet before = this_thread().blocked;
  set_blocked(before | only(SIGCHLD));
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  const sigset_t mask = to_sigset(before);
  sigset_t handled = to_sigset(0);
  if (interrupt.sa_handler != SIG_IGN) sigaddset(&handled, SIGINT);
  if (quit.sa_handler != SIG_IGN) sigaddset(&handled, SIGQUIT);
  posix_spawnattr_setsigmask(&attributes, &mask);
  posix_spawnattr_setsigdefault(&attributes, &handled);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  char* const words[] = {const_cast<char*>("sh"), const_cast<char*>("-c"), const_cast<char*>(command), nullptr};
  pid_t child = 0;
  int status = -1;
  const int error = posix_spawn(&child, "/bin/sh", nullptr, &attributes, words, environ);
  posix_spawnattr_destroy(&attributes);
  if (error == 0)
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
  else
    status = 127 << 8;
  sigaction(SIGINT, &interrupt, nullptr);
  sigaction(SIGQUIT, &quit, nullptr);
  set_blocked(before);
  if (deliverable(this_thread()) != 0) handle_signals();
  if (error != 0) errno = error;
  return status;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int execve(const char* path, char* const* words, char* const* environment) noexcept {
  const StartEnvironment started(environment);
  const RealMask mask;
  return WAITPOINT_NEXT(execve)(path, words, started.get());
}
WAITPOINT_INTERPOSED int execv(const char* path, char* const* words) noexcept { return execve(path, words, environ); }
WAITPOINT_INTERPOSED int execvpe(const char* file, char* const* words, char* const* environment) noexcept {
  const StartEnvironment started(environment);
  const RealMask mask;
  return WAITPOINT_NEXT(execvpe)(file, words, started.get());
}
WAITPOINT_INTERPOSED int execvp(const char* file, char* const* words) noexcept { return execvpe(file, words, environ); }
WAITPOINT_INTERPOSED int fexecve(int descriptor, char* const* words, char* const* environment) noexcept {
  const StartEnvironment started(environment);
  const RealMask mask;
  return WAITPOINT_NEXT(fexecve)(descriptor, words, started.get());
}

WAITPOINT_INTERPOSED int execl(const char* path, const char* first, ...) noexcept {
  va_list more;
  va_start(more, first);
  const Words words(first, more);
  va_end(more);
  return words.get() == nullptr ? fail(ENOMEM) : execve(path, words.get(), environ);
}
WAITPOINT_INTERPOSED int execlp(const char* file, const char* first, ...) noexcept {
  va_list more;
  va_start(more, first);
  const Words words(first, more);
  va_end(more);
  return words.get() == nullptr ? fail(ENOMEM) : execvpe(file, words.get(), environ);
}
WAITPOINT_INTERPOSED int execle(const char* path, const char* first, ...) noexcept {
  va_list more;
  va_start(more, first);
  const Words words(first, more);
  char* const* const environment = va_arg(more, char* const*);
  va_end(more);
  return words.get() == nullptr ? fail(ENOMEM) : execve(path, words.get(), environment);
}

WAITPOINT_INTERPOSED int posix_spawn(pid_t* child, const char* path, const posix_spawn_file_actions_t* actions,
                                     const posix_spawnattr_t* attributes, char* const* words,
                                     char* const* environment) noexcept {
  pid_t made = 0;
  before_start(actions);
  const StartEnvironment started(environment);
  const RealMask mask;
  const int error =
      note_started(WAITPOINT_NEXT(posix_spawn)(&made, path, actions, attributes, words, started.get()), &made);
  if (error == 0 && child != nullptr) *child = made;
  return error;
}
WAITPOINT_INTERPOSED int posix_spawnp(pid_t* child, const char* file, const posix_spawn_file_actions_t* actions,
                                      const posix_spawnattr_t* attributes, char* const* words,
                                      char* const* environment) noexcept {
  pid_t made = 0;
  before_start(actions);
  const StartEnvironment started(environment);
  const RealMask mask;
  const int error =
      note_started(WAITPOINT_NEXT(posix_spawnp)(&made, file, actions, attributes, words, started.get()), &made);
  if (error == 0 && child != nullptr) *child = made;
  return error;
}

WAITPOINT_INTERPOSED FILE* popen(const char* command, const char* type) {
  before_start(nullptr);
  const StartEnvironment started(environ);
  const RealMask mask;
  // The C library starts the shell with `environ`.
  char** const own = environ;
  environ = const_cast<char**>(started.get());
  FILE* const stream = WAITPOINT_NEXT(popen)(command, type);
  environ = own;
  return stream;
}

WAITPOINT_INTERPOSED int system(const char* command) {
  if (!is_simulated()) return WAITPOINT_NEXT(system)(command);
  if (command == nullptr) return 1;
  return run_shell(command);
}
