// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/dpor.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fibers/explore/strategies/dependence.hpp"

namespace waitpoint::exploration {
namespace {

template <class Where, class Test>
bool any(const Where& where, Test test) {
  return std::any_of(where.begin(), where.end(), test);
}

}  // namespace

void Dpor::join(Clock& into, const Clock& other) {
  for (const auto& [task, events] : other) {
    std::uint32_t& known = into[task];
    known = std::max(known, events);
  }
}

void Dpor::add(std::vector<std::uint64_t>& to, std::uint64_t task) {
  if (std::find(to.begin(), to.end(), task) == to.end()) to.push_back(task);
}

std::vector<std::uint64_t> Dpor::progress() const {
  std::vector<std::uint64_t> numbers = dpor::to_numbers(std::span(path_).first(std::min(depth_, path_.size())));
  numbers.push_back(was_cut_ ? 1 : 0);
  return numbers;
}

void Dpor::resume(std::span<const std::uint64_t> progress) {
  WAITPOINT_CHECK(!progress.empty(), "a search is resumed from nothing");
  path_ = dpor::path_of(progress.first(progress.size() - 1));
  depth_ = path_.size();
  was_cut_ = progress.back() != 0;
}

void Dpor::begin(std::uint64_t, const Draws&, const Profile& profile) {
  memory_ = profile.memory;
  depth_ = 0;
  instants_ = 0;
  last_of_task_.clear();
  was_cut_ = false;
}

// In a new state, the first task that is not asleep; false if all are: the rest has been explored already.
bool Dpor::choose(State& state, const State* before) {
  if (before != nullptr)
    for (const Event& event : before->asleep)
      if (event.task != before->done.task && !are_dependent(event.action, before->done.action, memory_))
        state.asleep.push_back(event);
  for (const Event& event : state.ready) {
    if (any(state.asleep, [&](const Event& asleep) { return asleep.task == event.task; })) continue;
    state.done = event;
    state.to_try = state.tried = {event.task};
    return true;
  }
  return false;
}

// The clock of the event of its maker after which `task` was made. Later events of the maker do not happen before it.
Dpor::Clock Dpor::clock_of_making(const Task& task) const {
  for (std::size_t i = depth_; i-- > 0;) {
    const State& earlier = path_[i];
    if (earlier.is_of_task() && earlier.done.task == task.maker && earlier.sequence < task.made_after)
      return earlier.clock;
  }
  return {};
}

// Completes the clock of `state`, so far that of its task. Returns the states whose events race with its own.
std::vector<std::size_t> Dpor::racing_with(State& state) const {
  std::vector<std::size_t> racing;
  for (std::size_t i = depth_; i-- > 0;) {
    const State& earlier = path_[i];
    if (!earlier.is_of_task() || !are_dependent(earlier.done.action, state.done.action, memory_)) continue;
    if (earlier.happens_before(state.clock)) continue;
    if (earlier.instant == state.instant) racing.push_back(i);
    join(state.clock, earlier.clock);
  }
  return racing;
}

// The present event races with that of state `event`. To be tried there: the events since that do not depend on it,
// then the present one. It is enough to begin with any of the tasks whose events can be the first of these.
void Dpor::try_without(std::size_t event) {
  State& from = path_[event];
  std::vector<const State*> others;
  std::uint64_t first = 0;
  bool is_found = false;
  for (std::size_t i = event + 1; i <= depth_; ++i) {
    const State& state = path_[i];
    if (!state.is_of_task() || (i < depth_ && from.happens_before(state.clock))) continue;
    const bool can_be_first = !any(others, [&](const State* other) { return other->happens_before(state.clock); });
    others.push_back(&state);
    if (!can_be_first) continue;
    if (!from.is_ready(state.done.task)) {
      if (i == depth_) return;  // the earlier event has made it possible
      continue;
    }
    if (any(from.to_try, [&](std::uint64_t task) { return task == state.done.task; })) return;
    if (!is_found) first = state.done.task;
    is_found = true;
  }
  if (is_found) return add(from.to_try, first);
  for (const Event& ready : from.ready) add(from.to_try, ready.task);
}

void Dpor::execute(State& state, const Task& task) {
  const auto last = last_of_task_.find(task.id);
  state.sequence = task.sequence;
  state.instant = instants_;
  state.number = last != last_of_task_.end() ? path_[last->second].number + 1 : 0;
  state.clock = last != last_of_task_.end() ? path_[last->second].clock : clock_of_making(task);
  const std::vector<std::size_t> racing = racing_with(state);
  state.clock[state.done.task] = state.number + 1;
  for (const std::size_t event : racing) try_without(event);
  last_of_task_[state.done.task] = depth_;
}

std::uint32_t Dpor::next(const SwitchPoint& at) {
  instants_ += at.last == nullptr;
  const bool is_new = depth_ == path_.size();
  if (is_new) {
    State state;
    for (const Task* task : at.ready) state.ready.push_back({task->id, action_of(*task)});
    const State* before = nullptr;
    for (std::size_t i = depth_; i-- > 0 && before == nullptr;)
      if (path_[i].is_of_task()) before = &path_[i];
    if (!choose(state, before)) {
      was_cut_ = true;
      return cut;
    }
    path_.push_back(std::move(state));
  }
  State& state = path_[depth_];
  for (std::uint32_t i = 0; i < at.ready.size(); ++i) {
    if (at.ready[i]->id != state.done.task) continue;
    execute(state, *at.ready[i]);
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

// An event that ends the run, as that of a failure or of the last task that is not a service, prevents those of the
// others that are ready: each of them must be tried before it.
void Dpor::try_those_left_at_the_end() {
  for (std::size_t i = path_.size(); i-- > 0;) {
    if (!path_[i].is_of_task()) continue;
    for (const Event& event : path_[i].ready) add(path_[i].to_try, event.task);
    return;
  }
}

bool Dpor::end() {
  path_.resize(depth_);
  if (!was_cut_) try_those_left_at_the_end();
  for (; !path_.empty(); path_.pop_back()) {
    State& state = path_.back();
    if (!state.is_of_task()) {
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
