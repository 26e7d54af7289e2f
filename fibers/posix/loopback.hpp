// SPDX-License-Identifier: BSD-3-Clause
// Streams over the machine's loopback, between threads of a program or programs of a run.
//
// What is written there has arrived when the call returns, unless the system puts it off by the wall clock: a small
// piece until the one before is acknowledged, a connection that the listener's queue has no room for, and what comes
// next for a reader whose small buffer was full. In virtual time that would be for ever, or not at all. So none of them
// is put off.
#pragma once

namespace waitpoint::posix {

/// A socket was made.
void send_at_once(int descriptor);
/// `made` is another name of `from`, or was accepted by it: the system sends at once there too, and the program is told
/// what it asked `from` for.
void copy_delay(int from, int made);

}  // namespace waitpoint::posix
