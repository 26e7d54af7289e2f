// SPDX-License-Identifier: BSD-3-Clause
// Signals that end a run in good order. They are only noted here: whoever carries out the run asks.
#pragma once

namespace waitpoint::tools {

/// From now on the first SIGINT or SIGTERM is noted. A second one, unless it is the first one's echo of the same
/// moment, does what it does by default: whoever is in a hurry is heard.
void heed_signals();
/// The signal that came, or 0.
int interruption();
/// Forgets it: the next one is the first again.
void forget_interruption();

}  // namespace waitpoint::tools
