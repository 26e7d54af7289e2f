// SPDX-License-Identifier: BSD-3-Clause
//
// In place of the C library's exit() and _exit(): in a run they would end the process without a word, with a status
// that a CI takes for the run's; so would daemon(), and another program by exec(). The exit() of a return from main()
// is seen by a handler (kernel/fault_reports.cpp).
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdarg>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/process_end.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "tools/run/next_definition.hpp"

using waitpoint::tools::next_definition;

namespace {

constexpr std::size_t words_max = 256;

// Where robots' programs are simulated, the call may be theirs. An exit that has begun is not overtaken.
void refuse_in_run(const char* function) {
  if (waitpoint::sync::has_program_layer()) return;
  waitpoint::kernel::refuse_exit(function);
  if (const auto status = waitpoint::kernel::begun_exit_status()) syscall(SYS_exit_group, *status);
}

/// The words of an argument list, to the null at its end.
struct Words {
  Words(const char* first, va_list* list) : all{const_cast<char*>(first)} {
    for (std::size_t i = 0; all[i] != nullptr && i + 2 < words_max; ++i) all[i + 1] = va_arg(*list, char*);
  }
  char* all[words_max];
};

}  // namespace

extern "C" {

// The attribute of the C library's declaration: clang++ refuses the standard one here.
__attribute__((noreturn)) void _exit(int status) {
  if (waitpoint::sync::has_program_layer()) next_definition<void(int)>("_exit")(status);
  refuse_in_run("_exit()");
  status = waitpoint::kernel::settle_exit_status(status);
  for (;;) syscall(SYS_exit_group, status);
}

__attribute__((noreturn)) void exit(int status) {
  if (!waitpoint::sync::has_program_layer()) {
    refuse_in_run("exit()");
    if (const int settled = waitpoint::kernel::settle_exit_status(status); settled != status) {
      std::fflush(nullptr);
      syscall(SYS_exit_group, settled);
    }
  }
  next_definition<void(int)>("exit")(status);
  __builtin_unreachable();
}

__attribute__((noreturn)) void _Exit(int status) { _exit(status); }

// Its parent would end by the C library's own _exit().
int daemon(int no_chdir, int no_close) {
  refuse_in_run("daemon()");
  return next_definition<decltype(daemon)>("daemon")(no_chdir, no_close);
}

// In place of the run another program would go on, with its own status.
int execve(const char* path, char* const* words, char* const* environment) {
  refuse_in_run("execve()");
  return next_definition<decltype(execve)>("execve")(path, words, environment);
}
int execveat(int folder, const char* path, char* const* words, char* const* environment, int flags) {
  refuse_in_run("execveat()");
  return next_definition<decltype(execveat)>("execveat")(folder, path, words, environment, flags);
}
int fexecve(int file, char* const* words, char* const* environment) {
  refuse_in_run("fexecve()");
  return next_definition<decltype(fexecve)>("fexecve")(file, words, environment);
}
int execvpe(const char* file, char* const* words, char* const* environment) {
  refuse_in_run("execvpe()");
  return next_definition<decltype(execvpe)>("execvpe")(file, words, environment);
}
int execv(const char* path, char* const* words) { return execve(path, words, environ); }
int execvp(const char* file, char* const* words) { return execvpe(file, words, environ); }

int execl(const char* path, const char* word, ...) {
  va_list list;
  va_start(list, word);
  const Words words(word, &list);
  va_end(list);
  return execve(path, words.all, environ);
}
int execlp(const char* file, const char* word, ...) {
  va_list list;
  va_start(list, word);
  const Words words(word, &list);
  va_end(list);
  return execvpe(file, words.all, environ);
}
int execle(const char* path, const char* word, ...) {
  va_list list;
  va_start(list, word);
  const Words words(word, &list);
  char* const* const environment = va_arg(list, char* const*);
  va_end(list);
  return execve(path, words.all, environment);
}

}  // extern "C"
