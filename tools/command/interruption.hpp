// SPDX-License-Identifier: BSD-3-Clause
// Signals that end a run in good order. The handler only records them; the run's loop polls.
#pragma once

namespace waitpoint::tools {

/// Installs handlers that record the first SIGINT, SIGTERM or SIGHUP; nohup(1) keeps its effect. A second signal,
/// unless it is an echo of the first, has its default effect, so that a second Ctrl-C ends the process.
void heed_signals();
/// Writing to a full file (SIGXFSZ) or to a pipe without readers (SIGPIPE) becomes an error of the write, so that
/// outputs are given up in good order. Programs that this process executes have the default again; a handler of the
/// caller stays.
void prefer_errors_to_signals();
/// The recorded signal, or 0.
int interruption();
/// Clears the record: the next signal is the first again.
void forget_interruption();

}  // namespace waitpoint::tools
