// SPDX-License-Identifier: BSD-3-Clause
// Conditions of the start of a program, of several:
//
//   NAME          the program of this name has ended
//   NAME.started  it has been started
//   tcp:PORT      a socket of this machine listens at the port
//   PATH          with a '/': the file or socket exists
//
// Nodes of ROS have two further kinds, decided by their owner: modules/ros1/node_condition.hpp.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace waitpoint {

struct StartCondition {
  enum class Kind : unsigned char { end, start, port, file, topic, service };
  Kind kind = Kind::end;
  std::string of;  ///< a name or path
  int port = 0;

  /// True for a condition that another program's start or end fulfils.
  bool is_of_program() const { return kind == Kind::end || kind == Kind::start; }
};

/// Parses a condition, without checks of names. False for an invalid port or an empty text.
bool parse(const std::string& text, StartCondition& condition);
/// The text that parse() takes.
std::string in_words(const StartCondition& condition);

/// A program that waits for all conditions.
struct ConditionedStart {
  std::string_view name;
  std::span<const StartCondition> after;
};

/// Checks the conditions of programs on each other. Calls `refuse` with the index of the first program whose condition
/// is of a program that is not among them, and that condition; or with the first program that can never start, since
/// conditions form a cycle with it, and null.
void check_conditions(std::span<const ConditionedStart> programs,
                      const std::function<void(std::size_t program, const StartCondition* unknown)>& refuse);

/// True if a condition on a port or a file is fulfilled.
bool holds_outside(const StartCondition& condition);

}  // namespace waitpoint
