// SPDX-License-Identifier: BSD-3-Clause
// The reads-from relation of a schedule: at each event, which event had last changed its object. Who read whose write,
// who took the lock that whom released, who was signalled by whom: schedules that agree in it have the same result.
//
// Events are abstract: what a task does at an object, at any time. So few pairs stand for many schedules.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "fibers/explore/strategies/dependence.hpp"

namespace waitpoint::exploration {

/// Two abstract events of one object: `writer` is the last one before `reader` that changes it.
struct ReadsFrom {
  static constexpr std::uint64_t start = 0;  ///< as a writer: the object is as at its first use

  std::uint64_t object = 0;
  std::uint64_t writer = start;
  std::uint64_t reader = start;

  friend auto operator<=>(const ReadsFrom&, const ReadsFrom&) = default;
  std::uint64_t hash() const { return Digest::mix(object ^ Digest::mix(writer ^ Digest::mix(reader))); }
};

/// What a schedule shall have, or not have, of the relation.
struct Constraint {
  ReadsFrom pair;
  bool is_wanted = true;
  bool is_met = false;  ///< wanted, and has occurred in this schedule
};
using Constraints = std::vector<Constraint>;

/// The abstract event that is pending in `task`; 0 if it has no object.
inline std::uint64_t abstract_event(const kernel::Task& task) {
  if (task.at == nullptr || task.operation == kernel::Operation::join || task.operation == kernel::Operation::call)
    return 0;
  return Digest::mix(task.at->identity ^ Digest::mix(task.id + static_cast<std::uint64_t>(task.operation)));
}

}  // namespace waitpoint::exploration
