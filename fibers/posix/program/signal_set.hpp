// SPDX-License-Identifier: BSD-3-Clause
// Signal sets as words: bit n is signal n + 1.
#pragma once

#include <csignal>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"

namespace waitpoint::posix {

using SignalSet = std::uint64_t;

inline constexpr int signals_end = 65;  ///< one past the greatest
static_assert(signals_end - 1 == 8 * sizeof(SignalSet), "a set has a bit for each signal");
static_assert(sizeof(SignalSet) <= sizeof(sigset_t), "a set is the first word of a sigset_t");

constexpr bool is_signal(int number) { return number > 0 && number < signals_end; }
constexpr SignalSet only(int signal) {
  WAITPOINT_FAST_CHECK(is_signal(signal), "a set is made of a signal without a number");
  return SignalSet{1} << (signal - 1);
}
constexpr bool contains(SignalSet set, int signal) { return (set & only(signal)) != 0; }

/// Signals that cannot be blocked or handled; 32 and 33 are the C library's own.
inline constexpr SignalSet unblockable = only(SIGKILL) | only(SIGSTOP) | only(32) | only(33);
/// Raised by the processor.
inline constexpr SignalSet faults =
    only(SIGSEGV) | only(SIGBUS) | only(SIGFPE) | only(SIGILL) | only(SIGTRAP) | only(SIGSYS);
/// Those that end a program that has gone wrong, raised by the processor or abort().
inline constexpr SignalSet crashes = only(SIGSEGV) | only(SIGBUS) | only(SIGFPE) | only(SIGILL) | only(SIGABRT);
/// Ignored by default, and those that stop the process.
inline constexpr SignalSet ignored_by_default = only(SIGCHLD) | only(SIGURG) | only(SIGWINCH) | only(SIGCONT);
inline constexpr SignalSet stopping = only(SIGSTOP) | only(SIGTSTP) | only(SIGTTIN) | only(SIGTTOU);

inline SignalSet to_set(const sigset_t& from) {
  SignalSet set = 0;
  std::memcpy(&set, &from, sizeof set);
  return set;
}
inline sigset_t to_sigset(SignalSet set) {
  sigset_t to{};
  std::memcpy(&to, &set, sizeof set);
  return to;
}

}  // namespace waitpoint::posix
