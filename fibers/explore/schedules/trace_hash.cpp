// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/schedules/trace_hash.hpp"

#include <algorithm>

namespace waitpoint::exploration {
namespace {

constexpr std::uint64_t hash_of(std::uint64_t first, std::uint64_t second) {
  return Digest::mix(first + Digest::mix(second));
}

// Calls `use` with the number of each place in the set.
template <class Use>
void for_each(Places places, Use use) {
  for (Places left = places; left != 0; left &= left - 1) use(__builtin_ctzll(left));
}

constexpr int run_place = 0;
static_assert(place::run == 1 << run_place);

}  // namespace

// The hash of an event that comes upon this state.
inline std::uint64_t TraceHash::State::seen_by(std::uint64_t event, bool changes) const {
  if (change != 0) event = hash_of(event, change);
  return changes && looks != 0 ? hash_of(event, looks) : event;
}

inline void TraceHash::State::take(std::uint64_t event, bool changes) {
  if (changes)
    *this = {event, 0};
  else
    looks += event;
}

void TraceHash::clear() {
  last_.clear();
  objects_.clear();
  std::ranges::fill(places_, State());
  sum_ = 0;
}

std::uint64_t& TraceHash::last_of(const kernel::Task& task) {
  if (last_.size() <= task.number) last_.resize(task.number + 1, 0);
  std::uint64_t& last = last_[task.number];
  if (last == 0) last = Digest::mix(task.id);
  return last;
}

// Whether a join comes before or behind the end that it waits for makes no difference.
void TraceHash::add(const kernel::Task& task, Time now) {
  if (task.operation == kernel::Operation::join && task.at != nullptr) return;
  const Action action = action_of(task);
  const SegmentFootprint footprint = footprint_of(action, memory_);
  std::uint64_t& last = last_of(task);
  std::uint64_t event =
      hash_of(last ^ places_[run_place].change,
              (static_cast<std::uint64_t>(now.since_start().ns()) << 8) + static_cast<std::uint64_t>(action.operation));
  if ((footprint.changes & place::run) != 0) {
    event = hash_of(event, sum_);
    places_[run_place].change = event;
  } else {
    const Places changes = footprint.changes;
    const Places shared = (footprint.reads | changes) & ~place::run;
    State* const object = footprint.has_object ? &objects_[footprint.object] : nullptr;
    if (object != nullptr) event = object->seen_by(event, footprint.changes_object);
    for_each(shared, [&](int at) { event = places_[at].seen_by(event, (changes >> at & 1) != 0); });
    if (object != nullptr) object->take(event, footprint.changes_object);
    for_each(shared, [&](int at) { places_[at].take(event, (changes >> at & 1) != 0); });
  }
  last = event;
  sum_ += event;
}

void TraceHash::add(kernel::Choice choice, const kernel::Task& task, std::uint32_t chosen) {
  std::uint64_t& last = last_of(task);
  last = hash_of(last, (std::uint64_t{chosen} << 8) + static_cast<std::uint64_t>(choice));
  sum_ += last;
}

}  // namespace waitpoint::exploration
