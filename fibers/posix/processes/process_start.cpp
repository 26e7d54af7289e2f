// SPDX-License-Identifier: BSD-3-Clause
//
// Programs that this one starts. They inherit the signal mask of the starting thread, which the system does not know.
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>

#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/pace.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/processes/children.hpp"
#include "fibers/posix/processes/executable.hpp"
#include "fibers/posix/processes/started_programs.hpp"
#include "fibers/posix/program/repeatability.hpp"
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

/// A child that executes a program, and does not exist yet.
class Child {
 public:
  explicit Child(bool is_simulated) : is_simulated_(is_simulated) {
    pass(kernel::Operation::start, nullptr);
    note_start(!is_simulated);
    process_ = family::expect_child();
    if (process_ != nullptr) family::let_begin(*process_);
    if (process_ == nullptr || is_simulated) return;
    family::set_native(*process_, true);
    await_child_in_system();
  }
  bool has_room() const { return process_ != nullptr; }
  /// Null if it is native.
  const family::Process* simulated() const { return is_simulated_ ? process_ : nullptr; }
  /// `error`: of posix_spawn(). Returns its number.
  pid_t note(int error, pid_t in_system) {
    const pid_t id = process_->id;
    family::note_child(*process_, error == 0 ? in_system : -1);
    if (error == 0 && !is_simulated_) note_native_child(in_system);
    return id;
  }

 private:
  bool is_simulated_;
  family::Process* process_;
};

ProgramKind kind_in_simulation(const char* path) {
  const ProgramKind kind = record->settings.simulates_started ? kind_to_start(path) : ProgramKind::native;
  if (kind != ProgramKind::native) return kind;
  char source[PATH_MAX + 64];
  std::snprintf(source, sizeof source, "%s, which cannot be simulated,", path);
  note_unrepeatable(source);
  return kind;
}

using Spawn = decltype(&posix_spawn);
int spawn(Spawn real, const char* path, pid_t* child, const char* file, const posix_spawn_file_actions_t* actions,
          const posix_spawnattr_t* attributes, char* const* words, char* const* environment) {
  if (!is_simulated()) return real(child, file, actions, attributes, words, environment);
  if (is_in_process()) return ENOSYS;
  const ProgramKind kind = kind_in_simulation(path);
  Child made(kind != ProgramKind::native);
  if (!made.has_room()) return EAGAIN;
  const StartEnvironment started(environment, made.simulated(), kind);
  const RealMask mask;
  pid_t in_system = 0;
  const int error = real(&in_system, file, actions, attributes, words, started.get());
  const pid_t id = made.note(error, in_system);
  if (error == 0 && child != nullptr) *child = id;
  return error;
}

/// The calling process executes a program; returns only if that fails.
template <class Call>
int execute(const char* path, char* const* environment, Call call) {
  if (!is_simulated() || family::own == nullptr) return call(environment);
  const ProgramKind kind = kind_in_simulation(path);
  const bool simulated = kind != ProgramKind::native;
  pass(kernel::Operation::start, nullptr);
  note_start(!simulated);
  const StartEnvironment started(environment, simulated ? family::own : nullptr, kind);
  family::own->next.time = kernel::running->local_time;
  if (!simulated && family::has_others()) family::let_execute_natively(true);
  family::own->executes = simulated;
  int result = 0;
  {
    const RealMask mask;
    result = call(started.get());
  }
  family::own->executes = false;
  const ErrorNumberKept kept;
  if (family::own->is_native) family::let_execute_natively(false);
  return result;
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
  return execute(path, environment,
                 [&](char* const* variables) { return WAITPOINT_NEXT(execve)(path, words, variables); });
}
WAITPOINT_INTERPOSED int execv(const char* path, char* const* words) noexcept { return execve(path, words, environ); }
WAITPOINT_INTERPOSED int execvpe(const char* file, char* const* words, char* const* environment) noexcept {
  const FoundProgram found(file);
  return execute(found.path(), environment,
                 [&](char* const* variables) { return WAITPOINT_NEXT(execvpe)(file, words, variables); });
}
WAITPOINT_INTERPOSED int execvp(const char* file, char* const* words) noexcept { return execvpe(file, words, environ); }
WAITPOINT_INTERPOSED int fexecve(int descriptor, char* const* words, char* const* environment) noexcept {
  char path[40];
  std::snprintf(path, sizeof path, "/proc/self/fd/%d", descriptor);
  return execute(path, environment,
                 [&](char* const* variables) { return WAITPOINT_NEXT(fexecve)(descriptor, words, variables); });
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
                                     char* const* environment) {
  return spawn(WAITPOINT_NEXT(posix_spawn), path, child, path, actions, attributes, words, environment);
}
WAITPOINT_INTERPOSED int posix_spawnp(pid_t* child, const char* file, const posix_spawn_file_actions_t* actions,
                                      const posix_spawnattr_t* attributes, char* const* words,
                                      char* const* environment) {
  const FoundProgram found(file);
  return spawn(WAITPOINT_NEXT(posix_spawnp), found.path(), child, file, actions, attributes, words, environment);
}

WAITPOINT_INTERPOSED int system(const char* command) {
  if (!is_simulated()) return WAITPOINT_NEXT(system)(command);
  if (command == nullptr) return 1;
  return run_shell(command);
}
