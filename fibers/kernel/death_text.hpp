// SPDX-License-Identifier: BSD-3-Clause
// A signal of which the process dies, in words: "the process dies of SIGFPE (integer division by zero)".
#pragma once

#include <csignal>

namespace waitpoint::kernel {

/// Valid until the next call. Async-signal-safe.
const char* death_text(const siginfo_t& info);

}  // namespace waitpoint::kernel
