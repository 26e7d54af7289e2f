// SPDX-License-Identifier: BSD-3-Clause
// What an exhaustive search has left out, in all of its schedules.
#pragma once

#include <span>
#include <string>

#include "fibers/explore/strategies/schedule.hpp"
#include "fibers/explore/target/finding.hpp"

namespace waitpoint::exploration {

class Omissions {
 public:
  /// A schedule of the search has ended, with these choices.
  void take(const RunVerdict& verdict, std::span<const Decision> choices);

  /// Nothing but spurious wake-ups, which could repeat without end.
  bool are_usual() const { return !turns_ && !costs_ && !accesses_ && !values_ && !is_at_calls_; }
  /// Turns of spinning tasks, while others could continue or time could pass.
  bool turns() const { return turns_; }
  /// The program's accesses to memory were no switch points.
  bool is_at_calls() const { return is_at_calls_; }
  /// The reason why all schedules are not all orders; empty if they are.
  std::string unproved() const;
  /// ", switching at calls, except turns of spinning tasks and spurious wake-ups"; empty if there are none.
  std::string in_words() const;

 private:
  bool turns_ = false;
  bool costs_ = false;     // of computations between the offered values
  bool spurious_ = false;  // wake-ups
  bool accesses_ = false;  // switches at first accesses to memory
  bool values_ = false;    // of loads
  bool is_at_calls_ = false;
  bool has_futexes_ = false;  // of the program's own locks, without switches at their accesses
  bool is_outside_ = false;
  bool has_generated_code_ = false;
};

}  // namespace waitpoint::exploration
