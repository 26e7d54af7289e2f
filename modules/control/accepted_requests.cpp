// SPDX-License-Identifier: BSD-3-Clause
#include "modules/control/accepted_requests.hpp"

#include <algorithm>

namespace waitpoint::control {
namespace {

using Kind = Predicate::Kind;

bool meets(const ControlledRequest* request, std::size_t pattern) {
  return request != nullptr &&
         std::find(request->patterns.begin(), request->patterns.end(), pattern) != request->patterns.end();
}

}  // namespace

ControlledRequest* AcceptedRequests::find(std::uint32_t number) {
  const auto found = requests_.find(number);
  return found == requests_.end() ? nullptr : &found->second;
}

void AcceptedRequests::evaluate(const Change& change, Time now, std::vector<bool>& values) const {
  for (std::size_t v = 0; v < values.size(); ++v)
    if (automaton_.predicates()[v].is_of_request()) values[v] = value_of(automaton_.predicates()[v], change, now);
}

bool AcceptedRequests::value_of(const Predicate& predicate, const Change& change, Time now) const {
  switch (predicate.kind) {
    case Kind::requested: return meets(change.accepted, predicate.pattern);
    case Kind::succeeded: return change.is_success && meets(change.ended, predicate.pattern);
    case Kind::failed: return !change.is_success && meets(change.ended, predicate.pattern);
    default: break;
  }
  const bool is_running = predicate.kind == Kind::running;
  if (is_running && meets(change.accepted, predicate.pattern)) return true;
  return std::any_of(requests_.begin(), requests_.end(), [&](const auto& entry) {
    const bool is_left_out =
        std::find(change.without.begin(), change.without.end(), entry.first) != change.without.end();
    return !is_left_out && meets(&entry.second, predicate.pattern) &&
           (is_running || now - entry.second.accepted > predicate.time);
  });
}

std::optional<Time> AcceptedRequests::next_change(Time now) const {
  std::optional<Time> next;
  for (const Predicate& predicate : automaton_.predicates()) {
    if (predicate.kind != Kind::lasting) continue;
    for (const auto& [number, request] : requests_) {
      const Time change = request.accepted + predicate.time + Duration::from_ns(1);
      if (meets(&request, predicate.pattern) && change > now && (!next || change < *next)) next = change;
    }
  }
  return next;
}

}  // namespace waitpoint::control
