// SPDX-License-Identifier: BSD-3-Clause
// Signals that end a run in good order. The handler only records them; the run's loop polls.
#pragma once

namespace waitpoint::tools {

/// Installs handlers that record the first SIGINT or SIGTERM. A second signal, unless it is an echo of the first, has
/// its default effect, so that a second Ctrl-C ends the process.
void heed_signals();
/// The recorded signal, or 0.
int interruption();
/// Clears the record: the next signal is the first again.
void forget_interruption();

}  // namespace waitpoint::tools
