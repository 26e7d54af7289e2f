// SPDX-License-Identifier: BSD-3-Clause
// A medium between robots, as it is declared: how long what is sent takes, how far it reaches, and what is lost.
//
//   sent        on the air             arrives
//    |--queue--|--bytes/bandwidth--|--latency + distance * latency per metre--|
//
// Datagrams may be lost, and overtake each other where the latency varies. Streams and letters of mailboxes never are
// and never do: beyond the range they wait, and what the medium would bring earlier comes with what was sent before it.
#pragma once

#include <cstdint>
#include <limits>

#include "core/time.hpp"

namespace waitpoint::io {

struct Medium {
  /// Each message's latency is drawn from here, both ends included; equal for a fixed one. The least must be positive:
  /// it is what lets robots be simulated apart.
  Duration latency_least = std::chrono::milliseconds(1);
  Duration latency_most = std::chrono::milliseconds(1);
  Duration latency_per_metre = Duration();
  /// Of each robot to each other: messages queue behind each other. 0: unlimited.
  std::uint64_t bandwidth_bit_s = 0;
  double range_m = std::numeric_limits<double>::infinity();
  double loss = 0;                      ///< probability that a datagram is lost
  std::uint64_t queue_bytes = 1 << 20;  ///< a datagram that would wait behind more is dropped
  /// How often what waits beyond the range looks whether it can go.
  Duration range_check = std::chrono::milliseconds(100);
};

/// Throws BadInput, naming the value, where a medium makes no sense.
void check(const Medium& medium);

/// How long so many bytes are on the air.
Duration time_on_air(const Medium& medium, std::uint64_t bytes);

}  // namespace waitpoint::io
