// SPDX-License-Identifier: BSD-3-Clause
// A function whose result is delivered to a future, in the names and semantics of std::packaged_task and std::async.
//
// async(launch::async, ...) makes a thread of the calling task's robot, which the destructor of the last future joins;
// launch::deferred runs the function at the first wait without a timeout. With both flags, async makes a thread.
#pragma once

#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>

#include "fibers/sync/future.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {

/// The launch policy of async. Not the standard's type, which would bring in std::async by argument-dependent lookup.
enum class launch : std::uint8_t { async = 1, deferred = 2 };
constexpr launch operator|(launch a, launch b) {
  return static_cast<launch>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
constexpr launch operator&(launch a, launch b) {
  return static_cast<launch>(static_cast<unsigned>(a) & static_cast<unsigned>(b));
}

template <class Signature>
class packaged_task;

template <class Result, class... Arguments>
class packaged_task<Result(Arguments...)> {
 public:
  packaged_task() noexcept = default;
  template <class Function, class = std::enable_if_t<!std::is_same_v<std::remove_cvref_t<Function>, packaged_task>>>
  explicit packaged_task(Function&& function)
      : function_(std::make_unique<Holder<std::decay_t<Function>>>(std::in_place, std::forward<Function>(function))),
        state_(std::make_shared<sync::ResultState<Result>>()) {}
  packaged_task(packaged_task&&) noexcept = default;
  packaged_task& operator=(packaged_task&& other) noexcept {
    packaged_task(std::move(other)).swap(*this);
    return *this;
  }
  /// If it was never called, its future throws broken_promise.
  ~packaged_task() {
    if (state_ != nullptr && state_.use_count() > 1) state_->break_promise();
  }

  bool valid() const noexcept { return state_ != nullptr; }
  future<Result> get_future() {
    sync::existing(state_).retrieve();
    return future<Result>(state_);
  }
  /// A second call throws promise_already_satisfied; if the first has finished, without calling the function.
  void operator()(Arguments... arguments) { run(sync::Ready::now, std::forward<Arguments>(arguments)...); }
  void make_ready_at_thread_exit(Arguments... arguments) {
    run(sync::Ready::at_thread_exit, std::forward<Arguments>(arguments)...);
  }
  /// A new shared state, for another call and another future.
  void reset() {
    (void)sync::existing(state_);
    packaged_task fresh;
    fresh.state_ = std::make_shared<sync::ResultState<Result>>();
    fresh.function_ = std::move(function_);
    swap(fresh);
  }
  void swap(packaged_task& other) noexcept {
    function_.swap(other.function_);
    state_.swap(other.state_);
  }
  friend void swap(packaged_task& a, packaged_task& b) noexcept { a.swap(b); }

 private:
  struct Callable {
    virtual ~Callable() = default;
    virtual Result call(Arguments... arguments) = 0;
  };
  template <class Function>
  struct Holder : Callable {
    template <class From>
    Holder(std::in_place_t, From&& from) : function(std::forward<From>(from)) {}
    Result call(Arguments... arguments) override {
      if constexpr (std::is_void_v<Result>)
        (void)std::invoke(function, std::forward<Arguments>(arguments)...);
      else
        return std::invoke(function, std::forward<Arguments>(arguments)...);
    }
    Function function;
  };
  void run(sync::Ready when, Arguments... arguments) {
    sync::existing(state_).check_not_stored();
    const auto state = state_;
    state->set_from(when, [&]() -> Result { return function_->call(std::forward<Arguments>(arguments)...); });
  }

  std::unique_ptr<Callable> function_;
  std::shared_ptr<sync::ResultState<Result>> state_;
};

namespace sync {

/// The thread of an async call, and its result; the destructor joins the thread.
template <class T>
struct AsyncCall {
  ~AsyncCall() { task.await_end(); }
  std::shared_ptr<ResultState<T>> state = std::make_shared<ResultState<T>>();
  thread task;
};

}  // namespace sync

template <class Function, class... Arguments>
using async_result = std::invoke_result_t<std::decay_t<Function>, std::decay_t<Arguments>...>;

template <class Function, class... Arguments>
[[nodiscard]] future<async_result<Function, Arguments...>> async(launch policy, Function&& function,
                                                                 Arguments&&... arguments) {
  using Result = async_result<Function, Arguments...>;
  auto call = [parts = std::make_shared<std::tuple<std::decay_t<Function>, std::decay_t<Arguments>...>>(
                   std::forward<Function>(function), std::forward<Arguments>(arguments)...)]() -> Result {
    return std::apply([](auto&&... part) -> Result { return std::invoke(std::move(part)...); }, std::move(*parts));
  };
  if ((policy & launch::async) != launch::async) {
    auto state = std::make_shared<sync::ResultState<Result>>();
    state->defer([state = state.get(), call] { state->set_from(sync::Ready::now, call); });
    return future<Result>(std::move(state));
  }
  auto started = std::make_shared<sync::AsyncCall<Result>>();
  // The thread shares ownership of the state: at the end of a run, the futures may be destroyed before it.
  started->task = thread({.name = "async"}, [state = started->state, call] {
    state->own();
    state->set_from(sync::Ready::now, call);
  });
  sync::ResultState<Result>* state = started->state.get();
  return future<Result>(std::shared_ptr<sync::ResultState<Result>>(std::move(started), state));
}

template <class Function, class... Arguments>
requires(!std::is_same_v<std::decay_t<Function>, launch>)
    [[nodiscard]] future<async_result<Function, Arguments...>> async(Function&& function, Arguments&&... arguments) {
  return async(launch::async | launch::deferred, std::forward<Function>(function),
               std::forward<Arguments>(arguments)...);
}

}  // namespace waitpoint
