// SPDX-License-Identifier: BSD-3-Clause
// A thread that is asked to stop and joined by the destructor of its handle, in the names and semantics of
// std::jthread.
#pragma once

#include "fibers/sync/stop_token.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {

class jthread {
 public:
  using id = thread::id;
  using native_handle_type = thread::native_handle_type;

  jthread() noexcept : source_(nostopstate) {}
  /// A function whose first parameter is a stop_token receives this thread's.
  template <class Function, class... Arguments>
  requires(!std::is_same_v<std::remove_cvref_t<Function>, jthread> &&
           !std::is_same_v<std::remove_cvref_t<Function>, thread_attributes>) explicit jthread(Function&& function,
                                                                                               Arguments&&... arguments)
      : jthread(thread_attributes{}, std::forward<Function>(function), std::forward<Arguments>(arguments)...) {}
  template <class Function, class... Arguments>
  jthread(const thread_attributes& attributes, Function&& function, Arguments&&... arguments)
      : thread_(start(source_, attributes, std::forward<Function>(function), std::forward<Arguments>(arguments)...)) {}
  jthread(jthread&&) noexcept = default;
  jthread& operator=(jthread&& other) noexcept {
    jthread(std::move(other)).swap(*this);
    return *this;
  }
  /// Asks the thread to stop and joins it. While a run is unwound, and after it, the thread is detached.
  ~jthread() {
    if (!joinable() || kernel::running == nullptr) return;
    request_stop();
    thread_.await_end();
  }

  bool joinable() const noexcept { return thread_.joinable(); }
  void join() { thread_.join(); }
  template <class Rep, class Ratio>
  bool try_join_for(const std::chrono::duration<Rep, Ratio>& span) {
    return thread_.try_join_for(span);
  }
  template <class Clock, class Span>
  bool try_join_until(const std::chrono::time_point<Clock, Span>& deadline) {
    return thread_.try_join_until(deadline);
  }
  void detach() { thread_.detach(); }
  id get_id() const noexcept { return thread_.get_id(); }
  native_handle_type native_handle() const noexcept { return thread_.native_handle(); }
  static unsigned hardware_concurrency() noexcept { return thread::hardware_concurrency(); }

  stop_source get_stop_source() const noexcept { return source_; }
  stop_token get_stop_token() const noexcept { return source_.get_token(); }
  bool request_stop() { return source_.request_stop(); }

  void swap(jthread& other) noexcept {
    source_.swap(other.source_);
    thread_.swap(other.thread_);
  }
  friend void swap(jthread& a, jthread& b) noexcept { a.swap(b); }

 private:
  template <class Function, class... Arguments>
  static thread start(const stop_source& source, const thread_attributes& attributes, Function&& function,
                      Arguments&&... arguments) {
    if constexpr (std::is_invocable_v<std::decay_t<Function>, stop_token, std::decay_t<Arguments>...>)
      return thread(attributes, std::forward<Function>(function), source.get_token(),
                    std::forward<Arguments>(arguments)...);
    else
      return thread(attributes, std::forward<Function>(function), std::forward<Arguments>(arguments)...);
  }

  stop_source source_;
  thread thread_;
};

}  // namespace waitpoint
