// SPDX-License-Identifier: BSD-3-Clause
// A visit to a parked task: a call on top of its stack, outside of virtual time (Scheduler::visit).
#pragma once

namespace waitpoint::kernel {

/// The call, as a member of its arguments. It must return, and pass no waitpoint.
struct Visit {
  void (*act)(Visit&) = nullptr;
};

}  // namespace waitpoint::kernel
