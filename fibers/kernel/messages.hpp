// SPDX-License-Identifier: BSD-3-Clause
// Messages between robots. Each is the event of its arrival; no robot can affect another within the least latency.
#pragma once

#include <cstdint>

#include "core/time.hpp"

namespace waitpoint::kernel {

class Scheduler;
struct EventNode;
struct Robot;

/// Inserts the arrival of a message of `sender`, ahead of the tasks of that instant and behind its timers. Arrivals at
/// one instant are ordered by {sender, its count of messages}, regardless of the order of insertion.
void deliver(Scheduler& scheduler, EventNode& node, Time time, Robot& sender);
/// The same for a message that was sent, and counted, in another process.
void deliver(Scheduler& scheduler, EventNode& node, Time time, const Robot& sender, std::uint64_t count);

/// Declares a link between robots with a latency of at least `least`, which must be positive.
void declare_latency(Scheduler& scheduler, Duration least);
/// The least latency of all links: Duration::max() without links.
Duration lookahead(const Scheduler& scheduler);

}  // namespace waitpoint::kernel
