// SPDX-License-Identifier: BSD-3-Clause
// Signals that end a run in good order. They are only noted here: whoever carries out the run asks.
#pragma once

namespace waitpoint::tools {

/// From now on SIGINT and SIGTERM are noted: the first one of each. A second one does what it does by default.
void heed_signals();
/// The signal that came, or 0.
int interruption();
/// Forgets it, and heeds the next one as if it were the first.
void forget_interruption();

}  // namespace waitpoint::tools
