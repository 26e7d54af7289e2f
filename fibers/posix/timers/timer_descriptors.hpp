// SPDX-License-Identifier: BSD-3-Clause
// timerfd: descriptors that become readable at a virtual time. Each is an eventfd. The first expiration is written into
// it by an event; later ones are added when the program reads, so that a timer that is never read does not keep the run
// alive.
#pragma once

namespace waitpoint::posix {

/// After the close of a descriptor: frees its timer, if it has one.
void forget_timer_descriptor(int descriptor);
/// Before a read: adds all expirations up to now to its count, and schedules the next one.
void bring_up_to_date(int descriptor);

bool is_timer_descriptor(int descriptor);

}  // namespace waitpoint::posix
