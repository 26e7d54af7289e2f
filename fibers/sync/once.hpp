// SPDX-License-Identifier: BSD-3-Clause
// One-time calls, in the names and semantics of std::once_flag and std::call_once.
//
// The first caller runs the function; the others wait until it has returned. If it throws, its caller gets the
// exception, and one of the waiters runs the function instead. A recursive call with the same flag is reported as a
// self-deadlock. After a run, the flag is unset again.
#pragma once

#include <functional>
#include <utility>

#include "fibers/sync/blocking.hpp"
#include "fibers/sync/object.hpp"

namespace waitpoint {

class once_flag {
 public:
  constexpr once_flag() = default;
  /// `label` is shown in reports; it must outlive the flag.
  explicit constexpr once_flag(const char* label) : object_("once flag", label) {}
  once_flag(const once_flag&) = delete;
  once_flag& operator=(const once_flag&) = delete;

 private:
  template <class Function, class... Arguments>
  friend void call_once(once_flag& flag, Function&& function, Arguments&&... arguments);

  // True if the caller must run the function and report the result to end(). False if it has returned already.
  bool begin();
  void end(bool returned);

  sync::Object object_{"once flag"};
  bool done_ = false;
};

template <class Function, class... Arguments>
void call_once(once_flag& flag, Function&& function, Arguments&&... arguments) {
  if (!flag.begin()) return;
  try {
    std::invoke(std::forward<Function>(function), std::forward<Arguments>(arguments)...);
  } catch (...) {
    flag.end(false);
    throw;
  }
  flag.end(true);
}

}  // namespace waitpoint
