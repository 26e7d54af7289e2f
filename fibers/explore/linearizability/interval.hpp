// SPDX-License-Identifier: BSD-3-Clause
// An operation's place in a history: the positions of its invocation and its response in the order of all of them.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace waitpoint::exploration {

/// Operation a precedes operation b in real time if a.responded < b.invoked.
struct Interval {
  std::uint32_t invoked = 0;
  std::uint32_t responded = pending;

  /// After all events: there is no response.
  static constexpr std::uint32_t pending = std::numeric_limits<std::uint32_t>::max();
};

/// "consumer#2": the running task, or "outside" of all tasks.
std::string running_title();

/// True if the running task is unwound: what its operations return then is not a response.
bool is_unwound();

}  // namespace waitpoint::exploration
