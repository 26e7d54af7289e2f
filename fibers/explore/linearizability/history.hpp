// SPDX-License-Identifier: BSD-3-Clause
// The operations that tasks invoked on an object under test, with the order of their invocations and responses.
//
// All tasks share one OS thread, so this order is total, and it follows from the schedule: an operation's effect is
// between its two events. Recording is no switch point and no access to shared memory, also under -fsanitize=thread.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "fibers/explore/linearizability/interval.hpp"
#include "fibers/sync/ignored_accesses.hpp"

namespace waitpoint {

/// `Model` is the sequential type (linearizable.hpp), of which only the types of its operations and results are used. A
/// history belongs to one run of a body: make it in the body.
template <class Model>
class History {
 public:
  using Operation = typename Model::Operation;
  using Result = typename Model::Result;

  struct Entry {
    Operation operation;
    std::optional<Result> result;  ///< none if pending
    bool returns = false;          ///< it returned its result, which is then shown
    exploration::Interval interval;
    std::string task;
  };

  /// Calls `function`, which performs `operation`, and returns its result. One that returns nothing has the result
  /// Result(). If an exception leaves it, the operation is pending: it may have had its effect or not.
  template <class Function>
  auto record(Operation operation, Function&& function) {
    const std::size_t number = invoke(std::move(operation));
    if constexpr (std::is_void_v<std::invoke_result_t<Function>>) {
      std::forward<Function>(function)();
      respond(number);
    } else {
      auto result = std::forward<Function>(function)();
      respond(number, Result(result));
      return result;
    }
  }

  /// The two halves of record(), for operations whose response comes elsewhere; the number identifies the operation.
  std::size_t invoke(Operation operation) {
    const sync::IgnoredAccesses ignored_accesses;
    entries_.push_back({std::move(operation), std::nullopt, false, {.invoked = events_}, exploration::running_title()});
    ++events_;
    return entries_.size() - 1;
  }
  void respond(std::size_t number, Result result) { respond(number, std::move(result), true); }
  void respond(std::size_t number) { respond(number, Result(), false); }

  /// In the order of invocation.
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  void respond(std::size_t number, Result result, bool returns) {
    if (exploration::is_unwound()) return;
    const sync::IgnoredAccesses ignored_accesses;
    Entry& entry = entries_[number];
    entry.result.emplace(std::move(result));
    entry.returns = returns;
    entry.interval.responded = events_++;
  }

  std::vector<Entry> entries_;
  std::uint32_t events_ = 0;
};

}  // namespace waitpoint
