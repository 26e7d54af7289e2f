// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/report/reordered_events.hpp"

#include <algorithm>
#include <map>

#include "fibers/explore/strategies/dependence.hpp"

namespace waitpoint::exploration {
namespace {

using kernel::Operation;

// Where a call that is made once has been made, another caller only looks.
bool may_call_once(Operation operation) { return operation == Operation::call_once || operation == Operation::load; }

bool is_same(const DoneEvent& a, const DoneEvent& b) {
  const bool is_once = a.object == b.object && may_call_once(a.operation) && may_call_once(b.operation);
  return a.event == b.event && (a.operation == b.operation || is_once);
}

bool is_unlock(Operation operation) { return operation == Operation::unlock || operation == Operation::unlock_shared; }
bool is_lock(Operation operation) { return operation == Operation::lock || operation == Operation::lock_shared; }

bool share_a_place(const DoneEvent& a, const DoneEvent& b) {
  const auto of = [](const DoneEvent& event) {
    SegmentFootprint footprint = footprint_of({event.operation, event.object, false, event.footprint}, Memory::sc);
    footprint.reads &= ~place::run, footprint.has_object = false;
    return footprint;
  };
  return are_dependent(of(a), of(b));
}

// For events of two tasks. Joining a thread does not affect it; and a lock operation has the same result just before
// and just after an unlock: only the order of lock operations matters.
bool depend(const DoneEvent& a, const DoneEvent& b) {
  if (a.event.task == b.event.task) return false;
  if (a.operation == Operation::exit || b.operation == Operation::exit) return true;
  if (a.operation == Operation::call || b.operation == Operation::call) return share_a_place(a, b);
  if (a.object == 0 || a.object != b.object) return false;
  if (is_read_only(a.operation) && is_read_only(b.operation)) return false;
  if (a.operation == Operation::join || b.operation == Operation::join) return false;
  return !(is_lock(a.operation) && is_unlock(b.operation)) && !(is_unlock(a.operation) && is_lock(b.operation));
}

using EventPlaces = std::map<EventOf, std::size_t>;

EventPlaces places_of(std::span<const DoneEvent> events) {
  EventPlaces places;
  for (std::size_t i = 0; i < events.size(); ++i) places.emplace(events[i].event, i);
  return places;
}

// An event that the passing run ends without, and the next one in the failing run that depends on it.
std::optional<EventPair> pair_with_an_absent_event(std::span<const DoneEvent> fails, std::span<const DoneEvent> passes,
                                                   std::size_t parting, const EventPlaces& in_passing) {
  for (std::size_t first = parting; first < fails.size(); ++first) {
    if (in_passing.contains(fails[first].event)) continue;
    for (std::size_t next = first + 1; next < fails.size(); ++next) {
      const auto again = in_passing.find(fails[next].event);
      if (again == in_passing.end() || again->second < parting || !depend(fails[first], fails[next])) continue;
      if (const DoneEvent& other = passes[again->second]; is_same(other, fails[next]))
        return EventPair{fails[first], other, static_cast<std::size_t>(first != parting) + 1};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<EventPair> pair_in_other_order(std::span<const DoneEvent> fails, std::span<const DoneEvent> passes) {
  const auto common = std::min(fails.size(), passes.size());
  std::size_t parting = 0;
  while (parting < common && is_same(fails[parting], passes[parting])) ++parting;
  const EventPlaces in_failing = places_of(fails), in_passing = places_of(passes);
  std::map<std::uint64_t, std::vector<std::size_t>> at_object;  // in the passing run; calls, as any others, at 0
  for (std::size_t i = parting; i < passes.size(); ++i) at_object[passes[i].object].push_back(i);
  for (std::size_t first = parting; first < fails.size(); ++first) {
    const auto again = in_passing.find(fails[first].event);
    if (again == in_passing.end() || !is_same(passes[again->second], fails[first])) continue;
    const DoneEvent& later = passes[again->second];
    std::optional<std::size_t> found;  // in the passing run: the candidate that comes first in the failing one
    std::size_t found_place = fails.size();
    for (const std::size_t before : at_object[later.object]) {
      if (before >= again->second) break;
      if (!depend(passes[before], later)) continue;
      const auto known = in_failing.find(passes[before].event);
      const std::size_t place = known == in_failing.end() ? fails.size() : known->second;
      if (place < first) continue;  // in the same order
      if (place < fails.size() && !(is_same(fails[place], passes[before]) && depend(fails[place], fails[first])))
        continue;
      if (found && place >= found_place) continue;
      found = before;
      found_place = place;
    }
    if (found)
      return EventPair{fails[first], passes[*found],
                       static_cast<std::size_t>(first != parting) + static_cast<std::size_t>(*found != parting)};
  }
  return pair_with_an_absent_event(fails, passes, parting, in_passing);
}

std::string with_calls(const std::string& event, const std::vector<std::string>& calls) {
  std::string text = event + "\n";
  for (const std::string& call : calls) text += "      at " + call + "\n";
  return text;
}

std::string pair_in_words(const std::string& failing, const std::string& passing) {
  return "the two events whose order matters:\n  first in the failing run:  " + failing +
         "  first in a passing run:    " + passing;
}

std::string no_pair_in_words() {
  return "no two events at one object are reordered in the passing run: timing or another choice matters\n";
}

}  // namespace waitpoint::exploration
