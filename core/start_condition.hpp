// SPDX-License-Identifier: BSD-3-Clause
// What a program, of several, waits for before its start:
//
//   NAME          the program of this name has ended
//   NAME.started  it has been started
//   tcp:PORT      a socket of this machine listens at the port
//   PATH          with a '/': the file or socket exists
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace waitpoint {

struct StartCondition {
  enum class Kind : unsigned char { end, start, port, file };
  Kind kind = Kind::end;
  std::string of;  ///< a name or path
  int port = 0;

  /// True for a condition that another program's start or end fulfils.
  bool is_of_program() const { return kind == Kind::end || kind == Kind::start; }
};

/// Parses a condition, without checks of names. False for an invalid port or an empty text.
bool parse(const std::string& text, StartCondition& condition);

/// A program that waits for all conditions.
struct ConditionedStart {
  std::string_view name;
  std::span<const StartCondition> after;
};
/// The index of the first program that can never start, since conditions on programs form a cycle with it; the number
/// of programs if there is none. Conditions are of programs among these.
std::size_t first_never_started(std::span<const ConditionedStart> programs);

/// True if a condition on a port or a file is fulfilled.
bool holds_outside(const StartCondition& condition);

}  // namespace waitpoint
