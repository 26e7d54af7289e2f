// SPDX-License-Identifier: BSD-3-Clause
// The function and arguments of a thread, in one allocation until the thread begins.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <tuple>
#include <type_traits>
#include <utility>

namespace waitpoint::sync {

class Call {
 public:
  virtual ~Call() = default;
  /// Must be called once.
  virtual void run() = 0;
};

template <class Function>
class CallOf final : public Call {
 public:
  explicit CallOf(Function function) : function_(std::move(function)) {}

  void run() override {
    if constexpr (sizeof function_ <= small) {
      // On the thread's own stack: the function's data shares the pages that the thread has anyway.
      Function function = std::move(function_);
      std::move(function)();
    } else {
      std::move(function_)();
    }
  }

 private:
  static constexpr std::size_t small = 512;  // relative to a thread's stack

  Function function_;
};

/// A function with its arguments.
template <class... Parts>
struct Bound {
  std::tuple<Parts...> parts;
  void operator()() && {
    std::apply([](auto&&... part) { std::invoke(std::move(part)...); }, std::move(parts));
  }
};

/// Copies or moves the function and its arguments, as std::thread does.
template <class Function, class... Arguments>
std::unique_ptr<Call> make_call(Function&& function, Arguments&&... arguments) {
  // Most are lambdas without arguments: no tuple is instantiated for each of them.
  if constexpr (sizeof...(Arguments) == 0 && std::is_invocable_v<std::decay_t<Function>&&>) {
    return std::unique_ptr<Call>(new CallOf<std::decay_t<Function>>(std::forward<Function>(function)));
  } else {
    using WithArguments = Bound<std::decay_t<Function>, std::decay_t<Arguments>...>;
    return std::unique_ptr<Call>(new CallOf<WithArguments>(
        WithArguments{{std::forward<Function>(function), std::forward<Arguments>(arguments)...}}));
  }
}

}  // namespace waitpoint::sync
