// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/unfinished_run.hpp"

#include "fibers/kernel/death_text.hpp"
#include "fibers/kernel/fault_reports.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {

UnfinishedRun::UnfinishedRun(const char* replay_line) {
  set_unfinished_run(replay_line);
  if (sanitizer::present) return;
  struct sigaction action {};
  action.sa_sigaction = handle;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK);
  for (std::size_t i = 0; i < std::size(signals); ++i) {
    struct sigaction present {};
    has_handler_[i] = sigaction(signals[i], nullptr, &present) == 0 && present.sa_handler == SIG_DFL;
    if (has_handler_[i]) sigaction(signals[i], &action, nullptr);
  }
}

UnfinishedRun::~UnfinishedRun() {
  set_unfinished_run(nullptr);
  for (std::size_t i = 0; i < std::size(signals); ++i)
    if (has_handler_[i]) std::signal(signals[i], SIG_DFL);
}

void UnfinishedRun::handle(int signal, siginfo_t* info, void*) {
  if (in_reporting_process()) report_death(death_text(*info));
  std::signal(signal, SIG_DFL);
  raise(signal);  // delivered when the handler has returned
}

}  // namespace waitpoint::kernel
