// SPDX-License-Identifier: BSD-3-Clause
// Interrupts threads that compute without calls, in loops that only a timer on their processor time or an asynchronous
// cancellation ends.
//
// While a thread has such a timer, or is cancelled asynchronously, a timer of the system ticks by the process's
// processor time. A thread that has made no call since the last tick spends virtual time at the tick: up to its next
// expiration, or a fixed time. So a loop that ends in this way ends at the same virtual time in each run; how often it
// goes round does not follow from the seed.
#pragma once

#include <csignal>

namespace waitpoint::posix {

/// At the beginning of a run.
void prepare_to_watch_computing();

/// True if the signal is the timer's.
bool is_tick(const siginfo_t& information);

/// At a tick: true if the running thread has computed since the last one, and something is to interrupt it.
bool is_to_be_interrupted();
/// It spends its time, and others get a turn; it may exit.
void spend_tick();

}  // namespace waitpoint::posix
