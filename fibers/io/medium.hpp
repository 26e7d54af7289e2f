// SPDX-License-Identifier: BSD-3-Clause
// The declared properties of a medium between robots: latency, bandwidth, range and loss.
//
//   sent        on the air             arrives
//    |--queue--|--bytes/bandwidth--|--latency + distance * latency per metre--|
//
// Datagrams may be lost, and arrive out of order if the latency varies. Streams and letters of mailboxes are reliable
// and ordered: beyond the range they wait, and an early arrival is delayed until those sent before it.
#pragma once

#include <cstdint>
#include <limits>

#include "core/time.hpp"

namespace waitpoint::io {

struct Medium {
  /// The bounds of each message's random latency, both included; equal for a fixed one. The least must be positive: it
  /// is the lookahead that lets robots be simulated apart.
  Duration latency_least = std::chrono::milliseconds(1);
  Duration latency_most = std::chrono::milliseconds(1);
  Duration latency_per_metre = Duration();
  /// From each robot to each other: messages queue for it. 0: unlimited.
  std::uint64_t bandwidth_bit_s = 0;
  double range_m = std::numeric_limits<double>::infinity();
  double loss = 0;                      ///< probability that a datagram is lost
  std::uint64_t queue_bytes = 1 << 20;  ///< a datagram that finds more bytes than this in the queue is dropped
  /// The interval at which messages beyond the range try again.
  Duration range_check = std::chrono::milliseconds(100);
};

/// Throws BadInput, naming the value, if a medium is invalid.
void check(const Medium& medium);

/// The transmission time of `bytes`.
Duration time_on_air(const Medium& medium, std::uint64_t bytes);

}  // namespace waitpoint::io
