// SPDX-License-Identifier: BSD-3-Clause
// The transport of messages between programs of different robots: the host's network.
#pragma once

#include <cstddef>

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

/// The host's network, which carries messages between guests of different robots.
struct Carrier {
  using Carry = bool (*)(void* network, const kernel::Robot& from, const kernel::Robot& to, std::size_t bytes,
                         void (*arrive)(void*), void (*drop)(void*), void* message);

  void* network;
  /// Sends a message of `bytes` bytes: `arrive` is called, outside all tasks, when it arrives, and `drop` after that or
  /// when it is lost. False, with neither called, if there is no link between the two.
  Carry carry;
  /// The same, but lossless and in the order of sending.
  Carry carry_in_order;
};

}  // namespace waitpoint::posix
