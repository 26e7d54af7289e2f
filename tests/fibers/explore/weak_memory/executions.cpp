// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/weak_memory/executions.hpp"

#include <algorithm>

#include "tests/fibers/explore/weak_memory/axioms.hpp"

namespace waitpoint::weak_memory {
namespace {

// All executions with these modification orders: each reading event from `event` on reads one of `stores`.
void read(const Litmus& litmus, Execution& execution, const std::vector<std::vector<std::size_t>>& stores,
          std::size_t event, const std::vector<std::size_t>* executed, Outcomes& found) {
  if (event == execution.events.size()) {
    if (is_allowed(execution, executed)) found.insert(execution.outcome(litmus));
    return;
  }
  if (!execution.events[event].step.reads()) return read(litmus, execution, stores, event + 1, executed, found);
  for (const std::size_t store : stores[event]) {
    execution.source[event] = store;
    read(litmus, execution, stores, event + 1, executed, found);
  }
}

class Interleavings {
 public:
  explicit Interleavings(const Litmus& litmus) : litmus_(litmus), execution_(litmus), next_(litmus.size(), 0) {
    std::size_t first = locations;
    for (const std::vector<Step>& thread : litmus) {
      first_.push_back(first);
      first += thread.size();
    }
    stores_.resize(execution_.events.size());
  }

  Outcomes all() {
    interleave();
    return found_;
  }

 private:
  void interleave() {
    if (executed_.size() + locations == execution_.events.size())
      return read(litmus_, execution_, stores_, 0, &executed_, found_);
    for (std::size_t thread = 0; thread < litmus_.size(); ++thread) {
      if (next_[thread] == litmus_[thread].size()) continue;
      const std::size_t event = first_[thread] + next_[thread]++;
      const Step& step = execution_.events[event].step;
      std::vector<std::size_t>& order = execution_.order[static_cast<std::size_t>(step.location)];
      stores_[event] = order;
      if (step.writes()) order.push_back(event);
      executed_.push_back(event);
      interleave();
      executed_.pop_back();
      if (step.writes()) order.pop_back();
      --next_[thread];
    }
  }

  const Litmus& litmus_;
  Execution execution_;
  std::vector<std::size_t> first_, next_, executed_;
  std::vector<std::vector<std::size_t>> stores_;  // by event: those before it, at its location
  Outcomes found_;
};

// All modification orders of the locations from `location` on.
void order(const Litmus& litmus, Execution& execution, int location, Outcomes& found) {
  if (location == locations) {
    std::vector<std::vector<std::size_t>> stores;
    for (const Event& event : execution.events)
      stores.push_back(execution.order[static_cast<std::size_t>(event.step.location)]);
    return read(litmus, execution, stores, 0, nullptr, found);
  }
  std::vector<std::size_t>& stores = execution.order[static_cast<std::size_t>(location)];
  for (std::size_t event = locations; event < execution.events.size(); ++event)
    if (execution.events[event].step.writes() && execution.events[event].step.location == location)
      stores.push_back(event);
  do order(litmus, execution, location + 1, found);
  while (std::next_permutation(stores.begin() + 1, stores.end()));
  stores.resize(1);
}

}  // namespace

Outcomes allowed(const Litmus& litmus) {
  Execution execution(litmus);
  Outcomes found;
  order(litmus, execution, 0, found);
  return found;
}

Outcomes executable(const Litmus& litmus) { return Interleavings(litmus).all(); }

}  // namespace waitpoint::weak_memory
