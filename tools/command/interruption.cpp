// SPDX-License-Identifier: BSD-3-Clause
#include "tools/command/interruption.hpp"

#include <csignal>
#include <ctime>

namespace waitpoint::tools {
namespace {

/// A second signal within this time is an echo of the first: timeout(1) sends one to the process and one to its group.
constexpr double echo_s = 0.2;

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
  } else if (seconds_since(noted_at) > echo_s) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // delivered when the handler has returned
  }
}

}  // namespace

void heed_signals() {
  struct sigaction action {};
  action.sa_handler = note;
  sigaddset(&action.sa_mask, SIGINT);
  sigaddset(&action.sa_mask, SIGTERM);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interruption() { return noted; }

void forget_interruption() { noted = 0; }

}  // namespace waitpoint::tools
