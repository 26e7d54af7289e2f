// SPDX-License-Identifier: BSD-3-Clause
// A result that one task provides and others wait for, in the names and semantics of std::promise, std::future and
// std::shared_future; misuse throws std::future_error with the standard's codes.
//
// Storing and waiting are waitpoints. A woken task continues at the virtual time of the storing.
#pragma once

#include "fibers/sync/shared_state.hpp"

namespace waitpoint {

template <class T>
class shared_future;

namespace sync {

/// Common part of future and shared_future.
template <class T>
class FutureBase {
 public:
  bool valid() const noexcept { return state_ != nullptr; }
  void wait() const { existing(state_).wait(); }
  /// `deferred` if the function runs only at the first wait without a timeout.
  template <class Rep, class Ratio>
  future_status wait_for(const std::chrono::duration<Rep, Ratio>& span) const {
    return existing(state_).wait_before(after(span));
  }
  template <class Clock, class Span>
  future_status wait_until(const std::chrono::time_point<Clock, Span>& deadline) const {
    return existing(state_).wait_before(until(deadline));
  }

 protected:
  FutureBase() noexcept = default;
  explicit FutureBase(std::shared_ptr<ResultState<T>> state) : state_(std::move(state)) {}

  std::shared_ptr<ResultState<T>> state_;
};

}  // namespace sync

template <class T>
class future : public sync::FutureBase<T> {
 public:
  future() noexcept = default;
  /// For promise, packaged_task and async.
  explicit future(std::shared_ptr<sync::ResultState<T>> state) : sync::FutureBase<T>(std::move(state)) {}
  future(future&&) noexcept = default;
  future& operator=(future&&) noexcept = default;

  /// Waits, and returns the result or rethrows its exception. The future is not valid afterwards.
  T get() {
    (void)sync::existing(this->state_);
    const auto state = std::move(this->state_);
    state->wait();
    state->rethrow_failure();
    if constexpr (std::is_reference_v<T>)
      return state->value();
    else if constexpr (!std::is_void_v<T>)
      return std::move(state->value());
  }
  shared_future<T> share() noexcept { return shared_future<T>(std::move(*this)); }

 private:
  friend class shared_future<T>;
};

template <class T>
class shared_future : public sync::FutureBase<T> {
 public:
  using Result =
      std::conditional_t<std::is_void_v<T> || std::is_reference_v<T>, T, std::add_lvalue_reference_t<const T>>;

  shared_future() noexcept = default;
  shared_future(future<T>&& other) noexcept : sync::FutureBase<T>(std::move(other.state_)) {}

  /// Waits, and returns a reference to the result, which lives as long as its futures, or rethrows its exception.
  Result get() const {
    sync::existing(this->state_).wait();
    this->state_->rethrow_failure();
    if constexpr (!std::is_void_v<T>) return this->state_->value();
  }
};

template <class T>
class promise {
 public:
  promise() : state_(std::make_shared<sync::ResultState<T>>()) {}
  promise(promise&& other) noexcept = default;
  promise& operator=(promise&& other) noexcept {
    promise(std::move(other)).swap(*this);
    return *this;
  }
  /// Without a stored result, its futures throw broken_promise.
  ~promise() {
    if (state_ != nullptr && state_.use_count() > 1) state_->break_promise();
  }

  future<T> get_future() {
    sync::existing(state_).retrieve();
    return future<T>(state_);
  }
  /// Takes a T (const T&, T&&, T& or nothing, by its kind).
  template <class... Value>
  requires(std::is_void_v<T> ? sizeof...(Value) == 0 : sizeof...(Value) == 1) void set_value(Value&&... value) {
    sync::existing(state_).set(sync::Ready::now, std::forward<Value>(value)...);
  }
  template <class... Value>
  requires(std::is_void_v<T> ? sizeof...(Value) == 0
                             : sizeof...(Value) == 1) void set_value_at_thread_exit(Value&&... value) {
    sync::existing(state_).set(sync::Ready::at_thread_exit, std::forward<Value>(value)...);
  }
  void set_exception(std::exception_ptr failure) { sync::existing(state_).fail(std::move(failure)); }
  void set_exception_at_thread_exit(std::exception_ptr failure) {
    sync::existing(state_).fail(std::move(failure), sync::Ready::at_thread_exit);
  }
  void swap(promise& other) noexcept { state_.swap(other.state_); }
  friend void swap(promise& a, promise& b) noexcept { a.swap(b); }

 private:
  std::shared_ptr<sync::ResultState<T>> state_;
};

}  // namespace waitpoint
