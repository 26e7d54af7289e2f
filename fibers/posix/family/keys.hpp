// SPDX-License-Identifier: BSD-3-Clause
// The keys of a family's processes, by which their events are ordered: see order.hpp.
#pragma once

#include "fibers/posix/family/family.hpp"

namespace waitpoint::posix::family {

/// The tie of a process's first event, in the seeded order; `maker` is the id of the task or robot that makes it.
inline std::uint64_t tie_of_first(std::uint64_t seed, std::uint64_t maker, const Process& process) {
  return Digest::mix(seed ^ Digest::mix(maker + static_cast<std::uint64_t>(process.id)));
}

/// True if it is simulated and neither stopped nor ended.
inline bool takes_turns(const Process& process) { return process.state == Process::State::alive && !process.is_native; }

/// A rung process comes before all tasks of the instant, in the order of the table.
inline kernel::EventKey key_of_ring(const Family& all, const Process& process) {
  const auto index = static_cast<std::uint64_t>(&process - all.processes);
  return {process.rung_at, kernel::make_order(kernel::Phase::deliveries, index)};
}

/// The key of its least event while it does not run; a ring is one.
inline kernel::EventKey key_of(const Family& all, const Process& process) {
  if (!takes_turns(process)) return kernel::EventKey::never();
  const kernel::EventKey ringing = key_of_ring(all, process);
  return process.is_rung && ringing < process.next ? ringing : process.next;
}

/// True if the event of `a` goes before that of `b`; equal keys are in the order of the table.
inline bool precedes(const Family& all, const Process& a, const Process& b) {
  const kernel::EventKey key_a = key_of(all, a), key_b = key_of(all, b);
  return key_a < key_b || (!(key_b < key_a) && &a < &b);
}

/// The process with the least event among those other than `own`; null without others.
inline Process* least_other(Family& all, const Process& own) {
  Process* least = nullptr;
  for (Process& process : entries_of(all)) {
    if (&process == &own || !takes_turns(process)) continue;
    if (least == nullptr || precedes(all, process, *least)) least = &process;
  }
  return least;
}

}  // namespace waitpoint::posix::family
