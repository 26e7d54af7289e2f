// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/dpor_path.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::exploration::dpor {
namespace {

// The order of the numbers, for both directions: pass() takes a number, and a sequence after its length.
template <class Pass, class E>
void pass_event(Pass& pass, E& event) {
  pass(event.task);
  pass(event.action.operation);
  pass(event.action.object);
  pass(event.action.is_on_shared_processor);
  pass(event.action.declared.reads);
  pass(event.action.declared.changes);
}

template <class Pass, class S>
void pass_state(Pass& pass, S& state) {
  for (auto* events : {&state.ready, &state.asleep}) {
    pass.resize(*events);
    for (auto& event : *events) pass_event(pass, event);
  }
  for (auto* tasks : {&state.to_try, &state.tried}) {
    pass.resize(*tasks);
    for (auto& task : *tasks) pass(task);
  }
  pass_event(pass, state.done);
  pass(state.count);
  pass(state.chosen);
}

struct Writer {
  template <class T>
  void operator()(const T& value) {
    numbers.push_back(static_cast<std::uint64_t>(value));
  }
  template <class T>
  void resize(const std::vector<T>& values) {
    (*this)(values.size());
  }
  std::vector<std::uint64_t> numbers;
};

struct Reader {
  template <class T>
  void operator()(T& value) {
    WAITPOINT_CHECK(!rest.empty(), "a search tree is shorter than it says");
    value = static_cast<T>(rest.front());
    rest = rest.subspan(1);
  }
  template <class T>
  void resize(std::vector<T>& values) {
    std::size_t size = 0;
    (*this)(size);
    values.resize(size);
  }
  std::span<const std::uint64_t> rest;
};

}  // namespace

bool State::is_ready(std::uint64_t task) const {
  return std::any_of(ready.begin(), ready.end(), [&](const Event& event) { return event.task == task; });
}

bool State::happens_before(const Clock& at) const {
  const auto known = at.find(done.task);
  return known != at.end() && known->second > number;
}

std::vector<std::uint64_t> to_numbers(std::span<const State> path) {
  Writer writer;
  for (const State& state : path) pass_state(writer, state);
  return std::move(writer.numbers);
}

Path path_of(std::span<const std::uint64_t> numbers) {
  Path path;
  for (Reader reader{numbers}; !reader.rest.empty();) pass_state(reader, path.emplace_back());
  return path;
}

}  // namespace waitpoint::exploration::dpor
