// SPDX-License-Identifier: BSD-3-Clause
// Doing something once, in the names and semantics of std::once_flag and std::call_once.
//
// Who comes first calls; the others wait until it has returned. If it throws, the exception is its caller's and one of
// those who wait calls in its place. A function that calls itself by the same flag waits for itself: a deadlock of one,
// reported as such. A flag that a run leaves behind reads as fresh in the next run.
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

  // True if the caller is to call; then it must say how that ended. False once somebody has returned.
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
