// SPDX-License-Identifier: BSD-3-Clause
// Asking a task to stop, in the names and semantics of std::stop_token, std::stop_source and std::stop_callback.
//
// The standard's own would do but for two things: asking is no waitpoint there, so that no schedule could come between,
// and a callback's destructor waits by spinning, which in one OS thread is for ever.
//
//   stop_source --+                   +-- stop_callback: in the state's list until called or destroyed
//   stop_token  --+--> StopState <----+
//
// Callbacks are called by the task that asks, in the order in which they were made. A state that a run leaves behind
// reads as fresh in the next run: nobody has asked.
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <type_traits>
#include <utility>

#include "fibers/sync/blocking.hpp"
#include "fibers/sync/unseen.hpp"

namespace waitpoint {
namespace sync {

/// A callback as its state sees it.
struct StopCallback {
  explicit StopCallback(void (*invoke_it)(StopCallback&)) : invoke(invoke_it) {}

  void (*invoke)(StopCallback&);
  StopCallback* next = nullptr;
  StopCallback* previous = nullptr;
  std::uint64_t epoch = 0;  ///< of the run in whose list it is; 0 when in none
};

/// What the sources, tokens and callbacks of one stop share.
class StopState {
 public:
  bool requested();
  /// Asks, and calls the callbacks; false if somebody had asked before, or the run is over.
  bool request();
  /// False if somebody had asked before: then `callback` is the caller's to call.
  bool add(StopCallback& callback);
  /// Takes `callback` out. If another task is calling it, waits until that is done.
  void remove(StopCallback& callback);

  /// Counts those who may ask.
  void add_source() {
    const Unseen unseen;
    ++sources_;
  }
  void remove_source() {
    const Unseen unseen;
    --sources_;
  }
  /// Without a waitpoint: whether there is somebody who has asked or may do so.
  bool possible() const {
    const Unseen unseen;
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
  StopCallback* called_ = nullptr;  // now, by the object's owner
};

}  // namespace sync

class stop_source;
template <class Callback>
class stop_callback;

class stop_token {
 public:
  stop_token() noexcept = default;

  /// A waitpoint: a task that asks again and again is seen to.
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

  /// True for the first who asks. The callbacks have been called then; an exception out of one ends the program, as the
  /// standard says.
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

  /// Calls `callback` at once if somebody has asked, else whoever asks will.
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
  /// When it returns, the callback is not called any more, unless it is the callback that destroys itself.
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
