// SPDX-License-Identifier: BSD-3-Clause
// Calls that wait for nothing, but read or change state that threads share: a semaphore's value, a file, a variable of
// the environment. In an exploration each of them is an event with its footprint, once the program has had a second
// thread or process. Else it is none, and costs nothing.
//
// Standard output and the standard error stream have no place when they are written: the order of outputs is no
// outcome.
#pragma once

#include <algorithm>
#include <cstddef>

#include "fibers/kernel/footprint.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/program/waiting.hpp"

namespace waitpoint::posix {

namespace place = kernel::place;
using kernel::changing;
using kernel::EventFootprint;
using kernel::Places;
using kernel::reading;

/// The program has had a second process.
inline constinit bool had_processes = false;

inline bool are_calls_events() {
  return is_simulated() && record != nullptr && record->settings.order == kernel::Order::explored &&
         (had_processes || this_program().threads_made > 1);
}

/// The event of the running thread before its call of `function`; `of` returns the call's footprint. If others change
/// it while the event is pending, as by moving the file that a path names, another event follows.
template <class Of>
void before_call(kernel::Object& function, Of of) {
  if (!are_calls_events()) return;
  const ErrorNumberKept kept;
  for (EventFootprint declared = of();;) {
    kernel::running->footprint = declared;
    pass(kernel::Operation::call, &function);
    kernel::running->footprint = {};
    const EventFootprint now = of();
    if (now == declared) return;
    declared = now;
  }
}

/// The name of a function, as an argument of a template.
template <std::size_t size>
struct FunctionName {
  consteval FunctionName(const char (&name)[size]) { std::copy_n(name, size, text); }
  char text[size];
};

/// For reports.
template <FunctionName name>
constinit kernel::Object function_named{"function", name.text};

template <FunctionName name, class Of>
void before_call(Of of) {
  before_call(function_named<name>, of);
}
template <FunctionName name>
void before_call(const EventFootprint& footprint) {
  before_call(function_named<name>, [&] { return footprint; });
}

/// The footprint of the events within its scope, beside what is known of their kinds.
class AlsoUsing {
 public:
  explicit AlsoUsing(const EventFootprint& footprint) {
    if (are_calls_events()) kernel::running->footprint = footprint;
  }
  ~AlsoUsing() {
    if (kernel::running != nullptr) kernel::running->footprint = {};
  }
  AlsoUsing(const AlsoUsing&) = delete;
  AlsoUsing& operator=(const AlsoUsing&) = delete;
};

}  // namespace waitpoint::posix
