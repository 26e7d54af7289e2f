// SPDX-License-Identifier: BSD-3-Clause
//
// In place of the C library's _exit(): in a task of a run it would end the process without a word, with a status that a
// CI takes for the run's; so would another program by exec(). exit() is seen by a handler of atexit()
// (kernel/fault_reports.cpp).
#include <dlfcn.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdarg>
#include <cstddef>

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/sync/system_calls.hpp"

namespace {
constexpr std::size_t words_max = 256;
}

extern "C" {

// The attribute of the C library's declaration: clang++ refuses the standard one here.
__attribute__((noreturn)) void _exit(int status) {
  if (waitpoint::sync::has_program_layer())  // it may be a program's
    reinterpret_cast<void (*)(int)>(dlsym(RTLD_NEXT, "_exit"))(status);
  waitpoint::kernel::refuse_exit("_exit()");
  for (;;) syscall(SYS_exit_group, status);
}

__attribute__((noreturn)) void _Exit(int status) { _exit(status); }

// In place of the run another program would go on, with its own status.
int execve(const char* path, char* const* words, char* const* environment) {
  waitpoint::kernel::refuse_exit("execve()");
  return reinterpret_cast<decltype(&execve)>(dlsym(RTLD_NEXT, "execve"))(path, words, environment);
}
int execv(const char* path, char* const* words) { return execve(path, words, environ); }
int execvp(const char* file, char* const* words) {
  waitpoint::kernel::refuse_exit("execvp()");
  return reinterpret_cast<decltype(&execvp)>(dlsym(RTLD_NEXT, "execvp"))(file, words);
}
int execl(const char* path, const char* word, ...) {
  char* words[words_max] = {const_cast<char*>(word)};
  va_list list;
  va_start(list, word);
  for (std::size_t i = 0; words[i] != nullptr && i + 2 < words_max; ++i) words[i + 1] = va_arg(list, char*);
  va_end(list);
  return execv(path, words);
}

}  // extern "C"
