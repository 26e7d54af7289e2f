// SPDX-License-Identifier: BSD-3-Clause
// The name and the description of a signal that ended a process.
#pragma once

#include <csignal>
#include <cstring>
#include <string>

namespace waitpoint::tools {

/// "SIGSEGV", "SIGRTMIN+2".
inline std::string signal_name(int signal) {
  const char* const name = sigabbrev_np(signal);
  return name != nullptr ? std::string("SIG") + name : "SIGRTMIN+" + std::to_string(signal - SIGRTMIN);
}

/// "signal 11 (Segmentation fault)".
inline std::string signal_in_words(int signal) {
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

}  // namespace waitpoint::tools
