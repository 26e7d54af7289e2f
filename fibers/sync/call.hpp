// SPDX-License-Identifier: BSD-3-Clause
// What a thread runs: a function and its arguments, in one piece of memory until the thread begins.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <tuple>
#include <utility>

namespace waitpoint::sync {

class Call {
 public:
  virtual ~Call() = default;
  /// To be done once.
  virtual void run() = 0;
};

template <class... Parts>
class CallOf final : public Call {
 public:
  template <class... Given>
  explicit CallOf(Given&&... given) : parts_(std::forward<Given>(given)...) {}

  void run() override {
    if constexpr (sizeof parts_ <= small) {
      // On the thread's own stack: what the function works with shares the pages that the thread has anyway.
      auto parts = std::move(parts_);
      invoke(parts);
    } else {
      invoke(parts_);
    }
  }

 private:
  static constexpr std::size_t small = 512;  // against the stack of a thread

  static void invoke(std::tuple<Parts...>& parts) {
    std::apply([](auto&&... part) { std::invoke(std::move(part)...); }, std::move(parts));
  }

  std::tuple<Parts...> parts_;
};

/// Copies or moves the function and its arguments, as std::thread does.
template <class... Parts>
std::unique_ptr<Call> make_call(Parts&&... parts) {
  return std::make_unique<CallOf<std::decay_t<Parts>...>>(std::forward<Parts>(parts)...);
}

}  // namespace waitpoint::sync
