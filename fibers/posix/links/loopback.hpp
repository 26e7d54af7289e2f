// SPDX-License-Identifier: BSD-3-Clause
// Streams over the machine's loopback, between threads of a program or programs of a run.
//
// What is written there has arrived when the call returns, unless the system puts it off by the wall clock: a small
// piece until the one before is acknowledged, which the reader's side may put off too; a connection that the listener's
// queue has no room for; buffers that grow with the speed it measures. In virtual time that would be for ever, or not
// at all. So none of them is put off.
#pragma once

namespace waitpoint::posix {

/// A socket that is to be one of the loopback's, by connect(), or may be, by listen(): those it accepts are as it is.
void send_at_once(int descriptor);
/// Something was received from it: the other side is told at once.
void acknowledge(int descriptor);

/// Whether it is such a socket.
bool sends_at_once(int descriptor);

/// A socket was made.
void begin_as_asked(int descriptor);
/// `made` is another name of `from`, or was accepted by it: the program is told what it asked `from` for.
void copy_asked(int from, int made);

}  // namespace waitpoint::posix
