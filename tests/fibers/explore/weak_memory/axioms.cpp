// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/weak_memory/axioms.hpp"

#include <algorithm>

namespace waitpoint::weak_memory {
namespace {

bool is_fence(const Event& event) { return event.step.kind == Step::Kind::fence; }
bool is_acquire(const Event& event) {
  const std::memory_order order = event.step.order;
  return (event.step.reads() || is_fence(event)) && order != relaxed && order != release;
}
bool is_release(const Event& event) {
  const std::memory_order order = event.step.order;
  return (event.step.writes() || is_fence(event)) && (order == release || order == acq_rel || order == seq_cst);
}
bool is_strong(const Event& event) { return event.thread >= 0 && event.step.order == seq_cst; }

Relation sequenced_before(const std::vector<Event>& events) {
  Relation before(events.size());
  for (std::size_t a = 0; a < events.size(); ++a)
    for (std::size_t b = a + 1; b < events.size(); ++b)
      if (events[a].thread == events[b].thread && events[a].thread >= 0) before.add(a, b);
  return before;
}

// A release operation or fence synchronises with the acquire operation or fence that reads from its release sequence.
Relation synchronises_with(const Execution& execution, const Relation& sequenced) {
  const std::vector<Event>& events = execution.events;
  Relation with(events.size());
  const auto each_acquiring = [&](std::size_t reader, const auto& found) {
    if (is_acquire(events[reader])) found(reader);
    for (std::size_t fence = 0; fence < events.size(); ++fence)
      if (is_fence(events[fence]) && is_acquire(events[fence]) && sequenced.has(reader, fence)) found(fence);
  };
  const auto each_releasing = [&](std::size_t head, const auto& found) {
    if (is_release(events[head])) found(head);
    for (std::size_t fence = 0; fence < events.size(); ++fence)
      if (is_fence(events[fence]) && is_release(events[fence]) && sequenced.has(fence, head)) found(fence);
  };
  for (std::size_t reader = 0; reader < events.size(); ++reader) {
    if (!events[reader].step.reads()) continue;
    // The heads of the release sequences that contain the store: backwards over read-modify-writes.
    for (std::size_t head = execution.source[reader]; events[head].thread >= 0; head = execution.source[head]) {
      each_releasing(head, [&](std::size_t a) { each_acquiring(reader, [&](std::size_t b) { with.add(a, b); }); });
      if (!events[head].step.reads()) break;
    }
  }
  return with;
}

Relation coherence_ordered_before(const Execution& execution) {
  Relation before(execution.events.size());
  for (const std::vector<std::size_t>& order : execution.order)
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t k = i + 1; k < order.size(); ++k) before.add(order[i], order[k]);
  for (std::size_t reader = 0; reader < execution.events.size(); ++reader) {
    const Event& event = execution.events[reader];
    if (!event.step.reads()) continue;
    const std::vector<std::size_t>& order = execution.order[static_cast<std::size_t>(event.step.location)];
    before.add(execution.source[reader], reader);
    for (auto later = std::find(order.begin(), order.end(), execution.source[reader]) + 1; later != order.end();
         ++later)
      if (*later != reader) before.add(reader, *later);
  }
  before.close();
  return before;
}

bool updates_are_atomic(const Execution& execution) {
  for (const std::vector<std::size_t>& order : execution.order)
    for (std::size_t i = 1; i < order.size(); ++i)
      if (execution.events[order[i]].step.reads() && execution.source[order[i]] != order[i - 1]) return false;
  return true;
}

// What S must contain.
Relation total_order(const Execution& execution, const Relation& sequenced, const Relation& synchronised,
                     const Relation& happens, const Relation& coherence) {
  const std::vector<Event>& events = execution.events;
  const std::size_t count = events.size();
  Relation strong_pairs(count), total(count);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
      if (synchronised.has(a, b) && is_strong(events[a]) && is_strong(events[b])) strong_pairs.add(a, b);
  Relation strongly = sequenced | strong_pairs | sequenced * happens * sequenced;
  strongly.close();
  // The operation itself, and the seq_cst fences around it.
  const auto each = [&](std::size_t event, bool is_before, const auto& found) {
    if (is_strong(events[event])) found(event);
    for (std::size_t fence = 0; fence < count; ++fence)
      if (is_fence(events[fence]) && is_strong(events[fence]) &&
          (is_before ? happens.has(fence, event) : happens.has(event, fence)))
        found(fence);
  };
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      if (is_strong(events[a]) && is_strong(events[b]) && strongly.has(a, b)) total.add(a, b);
      if (coherence.has(a, b))
        each(a, true, [&](std::size_t s) { each(b, false, [&](std::size_t t) { total.add(s, t); }); });
    }
  return total;
}

}  // namespace

void Relation::close() {
  for (std::size_t middle = 0; middle < rows_.size(); ++middle)
    for (std::size_t a = 0; a < rows_.size(); ++a)
      if (has(a, middle)) rows_[a] |= rows_[middle];
}

bool Relation::is_acyclic() const {
  Relation closed = *this;
  closed.close();
  for (std::size_t a = 0; a < rows_.size(); ++a)
    if (closed.has(a, a)) return false;
  return true;
}

Relation operator|(Relation a, const Relation& b) {
  for (std::size_t i = 0; i < a.rows_.size(); ++i) a.rows_[i] |= b.rows_[i];
  return a;
}

Relation operator*(const Relation& a, const Relation& b) {
  Relation both(a.rows_.size());
  for (std::size_t i = 0; i < a.rows_.size(); ++i)
    for (std::size_t middle = 0; middle < a.rows_.size(); ++middle)
      if (a.has(i, middle)) both.rows_[i] |= b.rows_[middle];
  return both;
}

Execution::Execution(const Litmus& litmus) : order(locations) {
  for (int location = 0; location < locations; ++location) {
    order[static_cast<std::size_t>(location)].push_back(events.size());
    events.push_back({store(location, 0, relaxed), -1});
  }
  for (std::size_t thread = 0; thread < litmus.size(); ++thread)
    for (const Step& step : litmus[thread]) events.push_back({step, static_cast<int>(thread)});
  source.assign(events.size(), 0);
}

Outcome Execution::outcome(const Litmus& litmus) const {
  std::vector<int> stored(events.size(), 0);
  for (const std::vector<std::size_t>& stores : order)
    for (const std::size_t event : stores) {
      const Step& step = events[event].step;
      stored[event] = step.kind == Step::Kind::add ? stored[source[event]] + step.value : step.value;
    }
  Outcome outcome;
  for (std::size_t event = 0; event < events.size(); ++event)
    if (events[event].step.reads()) outcome.push_back(stored[source[event]]);
  for (int location = 0; location < locations; ++location)
    if (is_final(litmus, location)) outcome.push_back(stored[order[static_cast<std::size_t>(location)].back()]);
  return outcome;
}

bool is_allowed(const Execution& execution, const std::vector<std::size_t>* executed) {
  if (!updates_are_atomic(execution)) return false;  // else they may read each other
  const std::size_t count = execution.events.size();
  const Relation sequenced = sequenced_before(execution.events);
  const Relation synchronised = synchronises_with(execution, sequenced);
  Relation happens = sequenced | synchronised;
  for (std::size_t initial = 0; initial < locations; ++initial)
    for (std::size_t event = locations; event < count; ++event) happens.add(initial, event);
  happens.close();
  const Relation coherence = coherence_ordered_before(execution);
  if (!happens.is_acyclic() || !coherence.is_acyclic()) return false;
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
      if (happens.has(a, b) && coherence.has(b, a)) return false;
  const Relation total = total_order(execution, sequenced, synchronised, happens, coherence);
  if (executed == nullptr) return total.is_acyclic();
  for (std::size_t i = 0; i < executed->size(); ++i)
    for (std::size_t k = 0; k <= i; ++k)
      if (total.has((*executed)[i], (*executed)[k])) return false;
  return true;
}

}  // namespace waitpoint::weak_memory
