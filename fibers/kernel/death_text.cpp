// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/death_text.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstring>

namespace waitpoint::kernel {
namespace {

struct Cause {
  int signal, code;  // 0: any
  const char* text;
};
constexpr Cause causes[] = {
    {SIGSEGV, SEGV_ACCERR, "an address without permission"},
    {SIGSEGV, 0, "a bad address"},
    {SIGBUS, BUS_ADRALN, "a misaligned address"},
    {SIGBUS, BUS_ADRERR, "an address beyond the end of its file"},
    {SIGILL, 0, "an illegal instruction"},
    {SIGFPE, FPE_INTDIV, "integer division by zero"},
    {SIGFPE, FPE_INTOVF, "integer overflow"},
    {SIGSYS, 0, "a forbidden system call"},
    {SIGALRM, 0, "an alarm"},
    {SIGXCPU, 0, "a limit of processor time, such as ulimit -t"},
};

const char* cause_of(const siginfo_t& info) {
  if (info.si_code == SI_TIMER) return "a timer of the process";
  if (info.si_code <= 0 && info.si_pid != getpid()) return "another process sent it";
  if (info.si_code <= 0) return info.si_signo == SIGABRT ? "abort() was called" : "the process sent it itself";
  for (const Cause& cause : causes)
    if (cause.signal == info.si_signo && (cause.code == info.si_code || cause.code == 0)) return cause.text;
  return nullptr;
}

}  // namespace

const char* death_text(const siginfo_t& info) {
  constinit static thread_local char text[96] = {};
  const char* const abbreviation = sigabbrev_np(info.si_signo);
  char name[24];
  if (abbreviation != nullptr)
    std::snprintf(name, sizeof name, "SIG%s", abbreviation);
  else
    std::snprintf(name, sizeof name, "SIGRTMIN+%d", info.si_signo - SIGRTMIN);
  const char* const cause = cause_of(info);
  std::snprintf(text, sizeof text, cause != nullptr ? "the process dies of %s (%s)" : "the process dies of %s", name,
                cause);
  return text;
}

}  // namespace waitpoint::kernel
