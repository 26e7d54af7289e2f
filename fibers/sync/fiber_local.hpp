// SPDX-License-Identifier: BSD-3-Clause
// A variable of which each task has its own: what thread_local is to threads. All fibers share one OS thread, so that
// thread_local itself is one variable for them all.
//
//   waitpoint::fiber_local<std::vector<int>> scratch;      // static, or a member
//   scratch->push_back(1);                                 // the running task's own, empty at first
//
// A value is made at the first use by its task, and destroyed when the task's function has returned or was left by an
// exception or by unwinding, the latest first.
#pragma once

#include <functional>
#include <type_traits>
#include <utility>

#include "fibers/sync/local_values.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {

template <class T>
class fiber_local {
 public:
  fiber_local() requires std::is_default_constructible_v<T>
  = default;
  /// `initial` makes the value of each task.
  explicit fiber_local(std::function<T()> initial) : initial_(std::move(initial)) {}
  fiber_local(const fiber_local&) = delete;
  fiber_local& operator=(const fiber_local&) = delete;

  /// The running task's own value.
  T& operator*() const { return get(); }
  T* operator->() const { return &get(); }
  T& get() const { return sync::values_of_running_task().get<T>(key_, initial_); }

 private:
  std::uint64_t key_ = sync::next_local_key();
  std::function<T()> initial_;
};

}  // namespace waitpoint
