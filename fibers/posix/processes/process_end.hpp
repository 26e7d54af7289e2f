// SPDX-License-Identifier: BSD-3-Clause
// The end of a process by itself.
#pragma once

namespace waitpoint::posix {

/// Immediately before main(), so that it precedes the destructors: the status of exit() is noted, also if the C library
/// calls it.
void note_exit_status();

}  // namespace waitpoint::posix
