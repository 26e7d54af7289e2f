// SPDX-License-Identifier: BSD-3-Clause
// The transport of messages between programs of different robots: the host's network, or that of a family.
#pragma once

#include <cstddef>

#include "fibers/kernel/task.hpp"

namespace waitpoint::posix {

struct SocketAddress;

/// The network that carries messages between programs of different robots.
struct Carrier {
  /// `to` is a receiver as `find` has returned it.
  using Carry = bool (*)(void* network, const kernel::Robot& from, const void* to, std::size_t bytes,
                         void (*arrive)(void*), void (*drop)(void*), void* message);

  void* network;
  /// Sends a message of `bytes` bytes: `arrive` is called, outside all tasks, when it arrives, and `drop` after that or
  /// when it is lost. False, with neither called, if there is no link between the two.
  Carry carry;
  /// The same, but lossless and in the order of sending.
  Carry carry_in_order;
  /// The receiver with a socket of this type at this address; null if no link leads there. Without this function
  /// receivers are the robots (kernel::Robot) of other programs in this process.
  const void* (*find)(const SocketAddress& address, int type) = nullptr;
};

}  // namespace waitpoint::posix
