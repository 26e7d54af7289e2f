// SPDX-License-Identifier: BSD-3-Clause
// Stop requests, in the names and semantics of std::stop_token, std::stop_source and std::stop_callback.
//
// The standard's own are unsuitable for two reasons: a request is not a waitpoint there, so that no schedule could
// interleave with it, and a callback's destructor waits by spinning, which never ends in a single OS thread.
//
//   stop_source --+                   +-- stop_callback: in the state's list until called or destroyed
//   stop_token  --+--> StopState <----+
//
// Callbacks are called by the requesting task, in order of construction. After a run, the state has no request any
// more.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <type_traits>
#include <utility>

#include "fibers/sync/blocking.hpp"
#include "fibers/sync/ignored_accesses.hpp"

namespace waitpoint {
namespace sync {

/// A callback, for its state.
struct StopCallback {
  explicit StopCallback(void (*invoke_it)(StopCallback&)) : invoke(invoke_it) {}

  void (*invoke)(StopCallback&);
  StopCallback* next = nullptr;
  StopCallback* previous = nullptr;
  std::uint64_t epoch = 0;  ///< the run in whose list it is; 0 if in none
};

/// The shared state of the sources, tokens and callbacks of one stop.
class StopState {
 public:
  bool requested();
  /// Requests a stop and calls the callbacks; false if it was requested before, or the run is over.
  bool request();
  /// False if the stop was requested before: the caller then calls `callback` itself.
  bool add(StopCallback& callback);
  /// Removes `callback`. If another task is calling it, waits for the call's end.
  void remove(StopCallback& callback);

  /// Counts the sources.
  void add_source() {
    const IgnoredAccesses ignored_accesses;
    ++sources_;
  }
  void remove_source() {
    const IgnoredAccesses ignored_accesses;
    --sources_;
  }
  /// True if a stop was requested or a source remains. No waitpoint.
  bool possible() const {
    const IgnoredAccesses ignored_accesses;
    return sources_ > 0 || requested_;
  }

 private:
  void refresh();
  void call(StopCallback& callback);
  void unlink(StopCallback& callback);

  kernel::Object object_{"stop state"};
  std::uint32_t sources_ = 0;
  bool requested_ = false;
  StopCallback* first_ = nullptr;
  StopCallback* last_ = nullptr;
  StopCallback* called_ = nullptr;  // the callback that the owner is calling
};

}  // namespace sync

class stop_source;
template <class Callback>
class stop_callback;

class stop_token {
 public:
  stop_token() noexcept = default;

  /// A waitpoint, so that polling loops let other tasks run.
  [[nodiscard]] bool stop_requested() const { return state_ != nullptr && state_->requested(); }
  [[nodiscard]] bool stop_possible() const noexcept { return state_ != nullptr && state_->possible(); }
  void swap(stop_token& other) noexcept { state_.swap(other.state_); }

  [[nodiscard]] friend bool operator==(const stop_token&, const stop_token&) noexcept = default;
  friend void swap(stop_token& a, stop_token& b) noexcept { a.swap(b); }

 private:
  friend class stop_source;
  template <class>
  friend class stop_callback;
  explicit stop_token(std::shared_ptr<sync::StopState> state) : state_(std::move(state)) {}

  std::shared_ptr<sync::StopState> state_;
};

struct nostopstate_t {
  explicit nostopstate_t() = default;
};
inline constexpr nostopstate_t nostopstate{};

class stop_source {
 public:
  stop_source() : state_(std::make_shared<sync::StopState>()) { state_->add_source(); }
  explicit stop_source(nostopstate_t) noexcept {}
  stop_source(const stop_source& other) noexcept : state_(other.state_) {
    if (state_ != nullptr) state_->add_source();
  }
  stop_source(stop_source&& other) noexcept = default;
  stop_source& operator=(stop_source other) noexcept {
    swap(other);
    return *this;
  }
  ~stop_source() {
    if (state_ != nullptr) state_->remove_source();
  }

  /// True for the first request. The callbacks have then been called; an exception from one ends the program, as in the
  /// standard.
  bool request_stop() {
    const std::shared_ptr<sync::StopState> state = state_;  // a callback may destroy this source
    return state != nullptr && state->request();
  }
  [[nodiscard]] bool stop_requested() const { return state_ != nullptr && state_->requested(); }
  [[nodiscard]] bool stop_possible() const noexcept { return state_ != nullptr; }
  [[nodiscard]] stop_token get_token() const noexcept { return stop_token(state_); }
  void swap(stop_source& other) noexcept { state_.swap(other.state_); }

  [[nodiscard]] friend bool operator==(const stop_source&, const stop_source&) noexcept = default;
  friend void swap(stop_source& a, stop_source& b) noexcept { a.swap(b); }

 private:
  std::shared_ptr<sync::StopState> state_;
};

template <class Callback>
class stop_callback : private sync::StopCallback {
 public:
  using callback_type = Callback;

  /// Calls `callback` at once if a stop was requested, else at the request.
  template <class Function>
  requires std::is_constructible_v<Callback, Function>
  explicit stop_callback(stop_token token, Function&& callback)
      : StopCallback(&stop_callback::call), callback_(std::forward<Function>(callback)) {
    if (!token.stop_possible()) return;
    if (token.state_->add(*this))
      state_ = std::move(token.state_);
    else
      call(*this);
  }
  /// The callback is not running on return, unless it destroys itself.
  ~stop_callback() {
    if (state_ != nullptr) state_->remove(*this);
  }
  stop_callback(const stop_callback&) = delete;
  stop_callback& operator=(const stop_callback&) = delete;

 private:
  static void call(sync::StopCallback& self) {
    try {
      std::forward<Callback>(static_cast<stop_callback&>(self).callback_)();
    } catch (const sync::Unwind&) {
      throw;
    } catch (...) {
      std::terminate();
    }
  }

  Callback callback_;
  std::shared_ptr<sync::StopState> state_;
};

template <class Callback>
stop_callback(stop_token, Callback) -> stop_callback<Callback>;

}  // namespace waitpoint
