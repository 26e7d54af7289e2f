// SPDX-License-Identifier: BSD-3-Clause
// The four classes of error.
//
//   a bug                an invariant of ours is broken: WAITPOINT_CHECK, always on; prints the place, the virtual
//                        time, the task, the seed and the replay line, then aborts
//   a misuse             a caller breaks the contract of a primitive: WAITPOINT_REQUIRE, always on; prints the virtual
//                        time, the task, the seed, the replay line and the caller's call stack, then aborts
//   bad input            a file, an option or a scenario is wrong: BadInput, thrown before time 0; one line, exit
//                        status 2
//   an expected outcome  a timeout, a full mailbox, a stale poster: a value, see the function that returns it
#pragma once

#include <stdexcept>
#include <string>

namespace waitpoint {

/// Unusable input. what() is the one line shown to the user: "file:line: what was expected".
class BadInput : public std::runtime_error {
 public:
  /// `line` counts from 1; 0 where the input has no lines (a missing file, an option).
  BadInput(const std::string& file, int line, const std::string& message);
  /// For input without a file: `where` is the option or key at fault.
  BadInput(const std::string& where, const std::string& message);

  /// The same with `note` at the end of its line: " (included at a.launch:3)".
  BadInput with_note(const std::string& note) const;

  const std::string& file() const { return file_; }
  int line() const { return line_; }

 private:
  BadInput(const BadInput& other, const std::string& note);

  std::string file_;
  int line_;
};

/// Reports a broken invariant and aborts. Used by WAITPOINT_CHECK.
[[noreturn]] void bug(const char* file, int line, const char* condition, const char* message);

/// Reports a caller's mistake and aborts. Used by WAITPOINT_REQUIRE.
[[noreturn]] void misuse(const char* message);

/// Writes the state of the run (virtual time, task, seed, replay line) to the error stream. Defined by the kernel;
/// without it, a bug is reported by its place alone.
extern "C" void waitpoint_describe_run() __attribute__((weak));

/// Writes the call stack of a misuse to the error stream, now or at the abort that follows. Defined by the primitives.
extern "C" void waitpoint_describe_caller() __attribute__((weak));

}  // namespace waitpoint

/// Aborts if `condition` is false; `message` names the broken invariant.
#define WAITPOINT_CHECK(condition, message)                    \
  (__builtin_expect(static_cast<bool>(condition), 1) ? (void)0 \
                                                     : ::waitpoint::bug(__FILE__, __LINE__, #condition, message))

/// Aborts if a caller breaks a contract; `message` names the mistake.
#define WAITPOINT_REQUIRE(condition, message) \
  (__builtin_expect(static_cast<bool>(condition), 1) ? (void)0 : ::waitpoint::misuse(message))

/// WAITPOINT_CHECK for fast paths, where the comparison would cost measurably: compiled in by -Dfast_path_checks=true,
/// which all builds with sanitizers and all fuzz targets set.
#ifdef WAITPOINT_FAST_PATH_CHECKS
#define WAITPOINT_FAST_CHECK(condition, message) WAITPOINT_CHECK(condition, message)
#else
#define WAITPOINT_FAST_CHECK(condition, message) static_cast<void>(sizeof(static_cast<bool>(condition)))
#endif
