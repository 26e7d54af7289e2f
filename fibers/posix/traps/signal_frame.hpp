// SPDX-License-Identifier: BSD-3-Clause
// The frame that the system makes on a stack for a signal's handler, moved to another stack. Fibers share one
// alternate stack of the system: a handler must have left it before another fiber runs.
#pragma once

#include <signal.h>
#include <ucontext.h>

namespace waitpoint::posix {

/// The code below the stack pointer that functions use without moving it.
inline constexpr long red_zone_bytes = 128;

using SignalHandler = void (*)(siginfo_t* information, ucontext_t* context);

/// Only in a handler, with its arguments: copies the frame below `top` and continues in `handler`, with the copy's
/// parts. The interrupted code goes on from the copy when that returns.
[[noreturn]] void continue_on(void* top, siginfo_t* information, ucontext_t* context, SignalHandler handler);

}  // namespace waitpoint::posix
