// SPDX-License-Identifier: BSD-3-Clause
// Streams over the machine's loopback, between threads of a program or programs of a run.
//
// Data written there has arrived when the call returns, unless the system delays it by the wall clock: a small segment
// until the one before is acknowledged, which the receiver may delay too; a connection that exceeds the listener's
// queue; buffers that grow with the measured speed. In virtual time these would take for ever, or no time at all. So
// all of them are disabled.
#pragma once

namespace waitpoint::posix {

/// Disables the delays of a socket that is about to connect to the loopback, or listens: accepted sockets inherit it.
void send_at_once(int descriptor);
/// After a reception: the acknowledgement is sent at once.
void acknowledge(int descriptor);

/// True after send_at_once().
bool sends_at_once(int descriptor);

/// A socket was made.
void begin_as_asked(int descriptor);
/// `made` is a duplicate of `from`, or was accepted by it: it shows the program the options set for `from`.
void copy_asked(int from, int made);

}  // namespace waitpoint::posix
