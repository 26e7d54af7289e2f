// SPDX-License-Identifier: BSD-3-Clause
// The shared state of the standard's futures: what a promise, a packaged task or async makes ready, once, and futures
// wait for.
//
//   promise, packaged_task --+                        +-- future, shared_future
//   async's thread         --+--> SharedState <-------+
//                                 value or exception
//
// Whoever is known to make it ready (async's thread, the task that runs a deferred function) owns it until then, so
// that waiting for each other is found as a deadlock.
#pragma once

#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "fibers/sync/clock.hpp"
#include "fibers/sync/unseen.hpp"

namespace waitpoint {

using std::future_errc;
using std::future_error;
using std::future_status;

namespace sync {

/// When what is stored is made ready: now, or when the running thread has ended.
enum class Ready : std::uint8_t { now, at_thread_exit };

/// The part that does not depend on the result's type.
class SharedState : public std::enable_shared_from_this<SharedState> {
 public:
  virtual ~SharedState() = default;

  /// Waits until ready, and runs what was deferred. Where the run is over it throws Unwind in any case.
  void wait();
  /// As wait(), but runs nothing.
  future_status wait_before(Time deadline);
  void rethrow_failure() const {
    if (failure_ != nullptr) std::rethrow_exception(failure_);
  }

  /// promise_already_satisfied where something is stored already.
  void fail(std::exception_ptr failure, Ready when = Ready::now);
  /// Stores broken_promise if nothing is stored. Never throws.
  void break_promise();
  void defer(std::function<void()> run) { deferred_ = std::move(run); }
  /// The running task is the one that will make it ready.
  void own();
  /// promise_already_satisfied where something is stored already. No waitpoint.
  void check_not_stored() const {
    if (stored_) throw future_error(future_errc::promise_already_satisfied);
  }
  /// future_already_retrieved at the second call.
  void retrieve();

 protected:
  // A waitpoint before storing; false where the run is over.
  bool claim();
  void store(Ready when);

 private:
  void publish();

  kernel::Object object_{"future"};
  bool stored_ = false;
  bool ready_ = false;
  bool retrieved_ = false;
  std::exception_ptr failure_;
  std::function<void()> deferred_;
};

template <class T>
class ResultState : public SharedState {
 public:
  template <class... Value>
  void set(Ready when, Value&&... value) {
    if (!claim()) return;
    const Unseen unseen;
    if constexpr (std::is_reference_v<T>)
      value_.emplace(&value...);
    else
      value_.emplace(std::forward<Value>(value)...);
    store(when);
  }
  /// Stores what `function` returns or throws.
  template <class Function, class... Arguments>
  void set_from(Ready when, Function&& function, Arguments&&... arguments) {
    try {
      if constexpr (std::is_void_v<T>) {
        std::invoke(std::forward<Function>(function), std::forward<Arguments>(arguments)...);
        set(when);
      } else {
        set(when, std::invoke(std::forward<Function>(function), std::forward<Arguments>(arguments)...));
      }
    } catch (const Unwind&) {
      throw;
    } catch (...) {
      fail(std::current_exception(), when);
    }
  }
  /// After wait().
  auto& value() {
    if constexpr (std::is_reference_v<T>)
      return **value_;
    else
      return *value_;
  }

 private:
  struct Nothing {};
  using Stored = std::conditional_t<std::is_void_v<T>, Nothing,
                                    std::conditional_t<std::is_reference_v<T>, std::remove_reference_t<T>*, T>>;
  std::optional<Stored> value_;
};

/// `state` as what std::future and its kin give to their user: no_state where there is none.
template <class State>
State& existing(const std::shared_ptr<State>& state) {
  if (state == nullptr) throw future_error(future_errc::no_state);
  return *state;
}

}  // namespace sync
}  // namespace waitpoint
