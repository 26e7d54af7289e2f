// SPDX-License-Identifier: BSD-3-Clause
// The way of messages between programs of different robots: the host's network.
#pragma once

#include <cstddef>

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

/// What carries messages between guests of two robots: the host's network.
struct Carrier {
  using Carry = bool (*)(void* network, const kernel::Robot& from, const kernel::Robot& to, std::size_t bytes,
                         void (*arrive)(void*), void (*drop)(void*), void* message);

  void* network;
  /// Sends a message of so many bytes: `arrive` is called when it arrives, by no task, if it does, and `drop` after
  /// that or when it is lost. False, with neither called, if there is no link between the two.
  Carry carry;
  /// The same, but it is not lost, and arrives after all that was sent so before.
  Carry carry_in_order;
};

}  // namespace waitpoint::posix
