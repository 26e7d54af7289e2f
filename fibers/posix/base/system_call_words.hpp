// SPDX-License-Identifier: BSD-3-Clause
// The arguments of a system call made by number, as words, and calls of functions with them.
#pragma once

#include <optional>
#include <type_traits>
#include <utility>

#include "core/error.hpp"

namespace waitpoint::posix {

template <class T>
T as(long word) {
  if constexpr (std::is_pointer_v<T>) {
    return reinterpret_cast<T>(word);
  } else {
    static_assert(sizeof(T) <= sizeof word, "an argument of a system call is a word");
    return static_cast<T>(word);
  }
}

/// A call's six arguments.
struct CallWords {
  long at[6];

  template <class Result, class... Arguments>
  long call(Result (*function)(Arguments...)) const {
    return call_with(function, std::index_sequence_for<Arguments...>());
  }
  template <class T>
  T word(int number) const {
    WAITPOINT_FAST_CHECK(number >= 0 && number < 6, "a system call has six arguments");
    return as<T>(at[number]);
  }

 private:
  template <class Result, class... Arguments, std::size_t... Numbers>
  long call_with(Result (*function)(Arguments...), std::index_sequence<Numbers...>) const {
    static_assert(sizeof...(Arguments) <= 6, "a system call has six arguments");
    if constexpr (std::is_pointer_v<Result>)
      return reinterpret_cast<long>(function(as<Arguments>(at[Numbers])...));
    else
      return static_cast<long>(function(as<Arguments>(at[Numbers])...));
  }
};

/// The call as syscall() makes it: simulated, or the system's; -1 with errno set if it fails.
long simulated_call(long number, const CallWords& words);

/// System calls about the state of files, by number; nullopt for others.
std::optional<long> call_about_files(long number, const CallWords& words);
/// System calls that take signal sets with their size, by number.
long call_about_signals(long number, const CallWords& words);

}  // namespace waitpoint::posix
