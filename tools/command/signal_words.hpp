// SPDX-License-Identifier: BSD-3-Clause
// What ended a process, in words.
#pragma once

#include <cstring>
#include <string>

namespace waitpoint::tools {

/// "signal 11 (Segmentation fault)".
inline std::string signal_in_words(int signal) {
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

}  // namespace waitpoint::tools
