// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/dpor.hpp"

#include <algorithm>

#include "fibers/explore/strategies/dependence.hpp"

namespace waitpoint::exploration {
namespace {

template <class Where, class Test>
bool any(const Where& where, Test test) {
  return std::any_of(where.begin(), where.end(), test);
}

}  // namespace

Dpor::Event Dpor::event_of(const Task& task) {
  return {task.id, task.operation, task.at != nullptr ? task.at->identity : 0};
}

bool Dpor::are_dependent(const Event& a, const Event& b) {
  // A yielding task is not offered until another has acted: the order of events around a yield matters.
  if (a.operation == kernel::Operation::yield || b.operation == kernel::Operation::yield) return true;
  if (releases_unseen(a.operation) && is_of_lock(b.operation)) return true;
  if (releases_unseen(b.operation) && is_of_lock(a.operation)) return true;
  return exploration::are_dependent(a.operation, a.object, b.operation, b.object);
}

void Dpor::join(Clock& into, const Clock& other) {
  for (const auto& [task, events] : other) {
    std::uint32_t& known = into[task];
    known = std::max(known, events);
  }
}

void Dpor::add(std::vector<std::uint64_t>& to, std::uint64_t task) {
  if (std::find(to.begin(), to.end(), task) == to.end()) to.push_back(task);
}

void Dpor::begin(std::uint64_t, const Draws&, const Profile&) {
  depth_ = 0;
  last_of_task_.clear();
}

// In a new state, the first task that is not asleep; false if all are: the rest has been explored already.
bool Dpor::choose(State& state, const State* before) {
  if (before != nullptr)
    for (const Event& event : before->asleep)
      if (event.task != before->done.task && !are_dependent(event, before->done)) state.asleep.push_back(event);
  for (const Event& event : state.ready) {
    if (any(state.asleep, [&](const Event& asleep) { return asleep.task == event.task; })) continue;
    state.done = event;
    state.to_try = state.tried = {event.task};
    return true;
  }
  return false;
}

// Adds backtracking points for the earlier events that race with `state`'s.
void Dpor::find_races(const State& state) {
  const Clock before = [&] {
    const auto last = last_of_task_.find(state.done.task);
    return last == last_of_task_.end() ? Clock() : path_[last->second].clock;
  }();
  for (std::size_t i = depth_; i-- > 0;) {
    State& earlier = path_[i];
    if (earlier.ready.empty() || earlier.done.task == state.done.task) continue;
    if (!are_dependent(earlier.done, state.done)) continue;
    const auto seen = before.find(earlier.done.task);
    if (seen != before.end() && seen->second > earlier.number) continue;
    const bool was_ready = any(earlier.ready, [&](const Event& event) { return event.task == state.done.task; });
    if (was_ready) {
      add(earlier.to_try, state.done.task);
    } else {
      for (const Event& event : earlier.ready) add(earlier.to_try, event.task);
    }
    return;
  }
}

void Dpor::execute(State& state, std::uint64_t maker) {
  find_races(state);
  const auto last = last_of_task_.find(state.done.task);
  state.clock.clear();
  state.number = 0;
  if (last != last_of_task_.end()) {
    state.clock = path_[last->second].clock;
    state.number = path_[last->second].number + 1;
  } else if (const auto made_by = last_of_task_.find(maker); made_by != last_of_task_.end()) {
    state.clock = path_[made_by->second].clock;
  }
  for (std::size_t i = 0; i < depth_; ++i)
    if (!path_[i].ready.empty() && are_dependent(path_[i].done, state.done)) join(state.clock, path_[i].clock);
  state.clock[state.done.task] = state.number + 1;
  last_of_task_[state.done.task] = depth_;
}

std::uint32_t Dpor::next(const SwitchPoint& at) {
  const bool is_new = depth_ == path_.size();
  if (is_new) {
    State state;
    for (const Task* task : at.ready) state.ready.push_back(event_of(*task));
    const State* before = nullptr;
    for (std::size_t i = depth_; i-- > 0 && before == nullptr;)
      if (!path_[i].ready.empty()) before = &path_[i];
    if (!choose(state, before)) return cut;
    path_.push_back(std::move(state));
  }
  State& state = path_[depth_];
  for (std::uint32_t i = 0; i < at.ready.size(); ++i) {
    if (at.ready[i]->id != state.done.task) continue;
    execute(state, at.ready[i]->maker);
    ++depth_;
    return i;
  }
  return cut;  // the body leaks state: the state differs now
}

std::uint32_t Dpor::among(Choice choice, const Task&, std::uint32_t count) {
  if (choice == Choice::spurious) return 0;
  if (depth_ == path_.size()) {
    path_.emplace_back();
    path_.back().count = choice == Choice::computing ? 2 : count;
  }
  const std::uint32_t chosen = path_[depth_++].chosen;
  return choice == Choice::computing && chosen == 1 ? count - 1 : chosen;
}

bool Dpor::end() {
  path_.resize(depth_);
  for (; !path_.empty(); path_.pop_back()) {
    State& state = path_.back();
    if (state.ready.empty()) {
      if (++state.chosen < state.count) return true;
      continue;
    }
    state.asleep.push_back(state.done);
    for (const std::uint64_t task : state.to_try) {
      if (std::find(state.tried.begin(), state.tried.end(), task) != state.tried.end()) continue;
      state.tried.push_back(task);
      if (any(state.asleep, [&](const Event& asleep) { return asleep.task == task; })) continue;
      for (const Event& event : state.ready)
        if (event.task == task) state.done = event;
      return true;
    }
  }
  return false;
}

}  // namespace waitpoint::exploration
