// SPDX-License-Identifier: BSD-3-Clause
// The reads-from relation of a schedule: at each event, which event had last changed what it is at. Who read whose
// write, who took the lock that whom released, who was signalled by whom: schedules that agree in it have the same
// result.
//
// Events are abstract: what a task does at an object, or by a call at a place of its footprint, at any time. So few
// pairs stand for many schedules.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "fibers/explore/strategies/dependence.hpp"
#include "fibers/explore/strategies/object_table.hpp"

namespace waitpoint::exploration {

/// Two abstract events of one object: `writer` is the last one before `reader` that changes it.
struct ReadsFrom {
  static constexpr std::uint64_t start = 0;  ///< as a writer: the object is as at its first use

  std::uint64_t object = 0;  ///< its identity; or for a place
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

/// An abstract event at an object or a place.
struct AbstractEvent {
  std::uint64_t object;  ///< as in ReadsFrom
  std::uint64_t event;
  bool changes;
};

/// Calls `use` with the abstract events of the one that is pending in `task`: at its object, and at the places that it
/// declares.
template <class Use>
void for_each_abstract_event(const kernel::Task& task, Use use) {
  const std::uint64_t identity = task.at != nullptr ? task.at->identity : 0;
  const std::uint64_t who = task.id + static_cast<std::uint64_t>(task.operation);
  // Of a call the object is the function's name.
  if (identity != 0 && task.operation != kernel::Operation::join && task.operation != kernel::Operation::call)
    use(AbstractEvent{identity, Digest::mix(identity ^ Digest::mix(who)), !is_read_only(task.operation)});
  const Places changes = task.footprint.changes & ~place::run;
  for (Places left = (task.footprint.reads & ~place::run) | changes; left != 0; left &= left - 1) {
    const Places at = left & -left;
    const std::uint64_t object = Digest::mix(at);
    use(AbstractEvent{object, Digest::mix(object ^ Digest::mix(who ^ Digest::mix(identity))), (changes & at) != 0});
  }
}

/// The relation of a schedule, up to its last event.
class ReadsFromRelation {
 public:
  void clear() {
    changes_.clear();
    pairs_.clear();
  }
  /// The event that has changed the object last.
  std::uint64_t last_change(std::uint64_t object) { return changes_[object]; }
  /// The pending event of `task` is next. `pass` is called with its pairs.
  template <class Pass>
  void note(const kernel::Task& task, Pass pass) {
    for_each_abstract_event(task, [&](const AbstractEvent& one) {
      std::uint64_t& change = changes_[one.object];
      pass(pairs_.emplace_back(ReadsFrom{one.object, change, one.event}));
      if (one.changes) change = one.event;
    });
  }
  void note(const kernel::Task& task) {
    note(task, [](const ReadsFrom&) {});
  }
  /// A pair for each abstract event, in their order.
  std::vector<ReadsFrom>& pairs() { return pairs_; }
  const std::vector<ReadsFrom>& pairs() const { return pairs_; }

 private:
  ObjectTable<std::uint64_t> changes_;  // by object: the event that has changed it last
  std::vector<ReadsFrom> pairs_;
};

}  // namespace waitpoint::exploration
