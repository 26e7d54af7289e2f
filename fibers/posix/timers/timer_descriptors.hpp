// SPDX-License-Identifier: BSD-3-Clause
// timerfd: descriptors that become readable at a virtual time. Underneath each is an eventfd, into which the count of
// expirations is written when the first comes; those after it are counted when the program reads, so that a timer which
// nobody reads does not keep the run going.
#pragma once

namespace waitpoint::posix {

/// It is closed: its timer, if it had one, is over.
void forget_timer_descriptor(int descriptor);
/// Before it is read: all expirations up to now are in its count, and the next one is awaited.
void bring_up_to_date(int descriptor);

bool is_timer_descriptor(int descriptor);

}  // namespace waitpoint::posix
