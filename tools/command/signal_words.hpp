// SPDX-License-Identifier: BSD-3-Clause
// The description of a signal that ended a process.
#pragma once

#include <cstring>
#include <string>

namespace waitpoint::tools {

/// "signal 11 (Segmentation fault)".
inline std::string signal_in_words(int signal) {
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

}  // namespace waitpoint::tools
