// SPDX-License-Identifier: BSD-3-Clause
#include "tools/interruption.hpp"

#include <csignal>

namespace waitpoint::tools {
namespace {

volatile std::sig_atomic_t noted = 0;

void note(int signal) { noted = signal; }

}  // namespace

void heed_signals() {
  struct sigaction action {};
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int interruption() { return noted; }

void forget_interruption() {
  noted = 0;
  heed_signals();
}

}  // namespace waitpoint::tools
