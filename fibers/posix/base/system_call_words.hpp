// SPDX-License-Identifier: BSD-3-Clause
// The words of a system call that a program makes by its number, and calls of functions with them.
#pragma once

#include <type_traits>
#include <utility>

namespace waitpoint::posix {

template <class T>
T as(long word) {
  if constexpr (std::is_pointer_v<T>)
    return reinterpret_cast<T>(word);
  else
    return static_cast<T>(word);
}

/// The words of a call.
struct CallWords {
  long at[6];

  template <class Result, class... Arguments>
  long call(Result (*function)(Arguments...)) const {
    return call_with(function, std::index_sequence_for<Arguments...>());
  }
  template <class T>
  T word(int number) const {
    return as<T>(at[number]);
  }

 private:
  template <class Result, class... Arguments, std::size_t... Numbers>
  long call_with(Result (*function)(Arguments...), std::index_sequence<Numbers...>) const {
    if constexpr (std::is_pointer_v<Result>)
      return reinterpret_cast<long>(function(as<Arguments>(at[Numbers])...));
    else
      return static_cast<long>(function(as<Arguments>(at[Numbers])...));
  }
};

/// What has sets of signals, with their size behind them: as the system's calls, of these numbers.
long call_about_signals(long number, const CallWords& words);

}  // namespace waitpoint::posix
