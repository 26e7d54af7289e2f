// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/interruption.hpp"

#include <csignal>
#include <ctime>
#include <initializer_list>

namespace waitpoint::tools {
namespace {

/// A second signal within this time is an echo of the first: timeout(1) sends one to the process and one to its group.
constexpr double echo_of_signal_s = 0.2;

volatile std::sig_atomic_t noted = 0;
timespec noted_at;

double seconds_since(const timespec& time) {
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec - time.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec - time.tv_nsec);
}

void note(int signal) {
  if (noted == 0) {
    clock_gettime(CLOCK_MONOTONIC, &noted_at);
    noted = signal;
  } else if (seconds_since(noted_at) > echo_of_signal_s) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // delivered when the handler has returned
  }
}

// Unlike SIG_IGN, a handler is not inherited by executed programs.
void do_nothing(int) {}

}  // namespace

void heed_signals() {
  struct sigaction action {};
  action.sa_handler = note;
  constexpr int ends[] = {SIGINT, SIGTERM, SIGHUP};
  for (const int signal : ends) sigaddset(&action.sa_mask, signal);
  for (const int signal : ends) {
    struct sigaction previous {};
    const bool is_ignored = sigaction(signal, nullptr, &previous) == 0 && previous.sa_handler == SIG_IGN;
    if (signal != SIGHUP || !is_ignored) sigaction(signal, &action, nullptr);
  }
}

void prefer_errors_to_signals() {
  for (const int signal : {SIGXFSZ, SIGPIPE}) {
    struct sigaction action {};
    if (sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
    action.sa_handler = do_nothing;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
}

int interruption() { return noted; }

void forget_interruption() { noted = 0; }

}  // namespace waitpoint::tools
