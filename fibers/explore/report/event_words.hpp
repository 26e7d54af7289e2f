// SPDX-License-Identifier: BSD-3-Clause
// An event in words: its operation and its object.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "fibers/kernel/operation.hpp"

namespace waitpoint::exploration {

/// "lock mutex #4". A task's `start` behind its first event makes another task or process, and a thread releases those
/// that wait for its end.
inline std::string event_in_words(kernel::Operation operation, std::uint64_t sequence, std::string_view kind,
                                  const std::string& object) {
  std::string text = kernel::name(operation);
  if (operation == kernel::Operation::start && sequence > 0) text = "create";
  if (operation == kernel::Operation::release && kind == "thread") text = "finish";
  return object.empty() ? text : text + " " + object;
}

}  // namespace waitpoint::exploration
