// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/unfinished_run.hpp"

#include <unistd.h>

#include <cstdlib>
#include <exception>

#include "fibers/kernel/death_text.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/kernel/process_end.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {
namespace {

std::terminate_handler terminate_before = nullptr;

// Its text and the abort() are one death.
[[noreturn]] void terminate() {
  begin_death();
  if (terminate_before != nullptr) terminate_before();
  std::abort();
}

void handle(int signal, siginfo_t* info, void*) {
  if (in_reporting_process()) report_death(death_text(*info));
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  sigaction(signal, &usual, nullptr);
  raise(signal);  // delivered when the handler has returned
}

}  // namespace

bool ends_process(int signal) {
  constexpr int named[] = {SIGQUIT, SIGUSR1,   SIGUSR2, SIGPIPE, SIGALRM, SIGSTKFLT,
                           SIGXCPU, SIGVTALRM, SIGPROF, SIGPOLL, SIGPWR,  SIGXFSZ};
  for (const int each : named)
    if (each == signal) return true;
  return signal >= SIGRTMIN && signal <= SIGRTMAX;
}

struct sigaction death_report() {
  struct sigaction action {};
  action.sa_sigaction = handle;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK);
  return action;
}

UnfinishedRun::UnfinishedRun(const char* replay_line) {
  set_unfinished_run(replay_line);
  if (sanitizer::present) return;
  terminate_before = std::set_terminate(terminate);
  const struct sigaction action = death_report();
  for (int signal = 1; signal < _NSIG; ++signal) {
    struct sigaction present {};
    is_handled_[static_cast<std::size_t>(signal)] =
        ends_process(signal) && sigaction(signal, nullptr, &present) == 0 && present.sa_handler == SIG_DFL;
    if (is_handled_[static_cast<std::size_t>(signal)]) sigaction(signal, &action, nullptr);
  }
}

UnfinishedRun::~UnfinishedRun() {
  set_unfinished_run(nullptr);
  if (sanitizer::present) return;
  if (std::get_terminate() == terminate) std::set_terminate(terminate_before);
  for (int signal = 1; signal < _NSIG; ++signal)
    if (is_handled_[static_cast<std::size_t>(signal)]) std::signal(signal, SIG_DFL);
}

void note_signal_to(pid_t process, int signal) {
  if (signal != SIGKILL || !(in_unfinished_run() || in_model_code())) return;
  const bool is_own = process == getpid() || process == 0 || process == -1 || process == -getpgrp();
  if (is_own) report_death("the process dies of SIGKILL (the process sent it itself)");
}

}  // namespace waitpoint::kernel
