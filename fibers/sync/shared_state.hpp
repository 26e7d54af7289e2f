// SPDX-License-Identifier: BSD-3-Clause
// The shared state of the standard's futures: made ready once by a promise, a packaged task or async; futures wait for
// it.
//
//   promise, packaged_task --+                        +-- future, shared_future
//   async's thread         --+--> SharedState <-------+
//                                 value or exception
//
// The task known to make it ready (async's thread, the one that runs a deferred function) owns it until then, so that
// circular waits are found as deadlocks.
#pragma once

#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "fibers/sync/clock.hpp"
#include "fibers/sync/ignored_accesses.hpp"

namespace waitpoint {

using std::future_errc;
using std::future_error;
using std::future_status;

namespace sync {

/// When a stored result is made ready: now, or at the end of the running thread.
enum class Ready : std::uint8_t { now, at_thread_exit };

/// The part that is independent of the result's type.
class SharedState : public std::enable_shared_from_this<SharedState> {
 public:
  virtual ~SharedState() = default;

  /// Waits until ready; runs a deferred function. Throws Unwind if the run is over, also in destructors.
  void wait();
  /// As wait(), but does not run a deferred function.
  future_status wait_before(Time deadline);
  void rethrow_failure() const {
    if (failure_ != nullptr) std::rethrow_exception(failure_);
  }

  /// Throws promise_already_satisfied if a result is stored already.
  void fail(std::exception_ptr failure, Ready when = Ready::now);
  /// Stores broken_promise unless a result is stored. Never throws.
  void break_promise();
  void defer(std::function<void()> run) { deferred_ = std::move(run); }
  /// Makes the running task the owner: it will make the state ready.
  void own();
  /// Throws promise_already_satisfied if a result is stored already. No waitpoint.
  void check_not_stored() const {
    if (stored_) throw future_error(future_errc::promise_already_satisfied);
  }
  /// Throws future_already_retrieved at the second call.
  void retrieve();

 protected:
  // A waitpoint before storing; false if the run is over.
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
    const IgnoredAccesses ignored_accesses;
    if constexpr (std::is_reference_v<T>)
      value_.emplace(&value...);
    else
      value_.emplace(std::forward<Value>(value)...);
    store(when);
  }
  /// Stores the result of `function`, or its exception.
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
  /// Valid after wait().
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

/// `state`, for use by std::future's counterparts: throws no_state if it is null.
template <class State>
State& existing(const std::shared_ptr<State>& state) {
  if (state == nullptr) throw future_error(future_errc::no_state);
  return *state;
}

}  // namespace sync
}  // namespace waitpoint
