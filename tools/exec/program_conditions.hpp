// SPDX-License-Identifier: BSD-3-Clause
// What a program meets beside its schedule: what its computing costs, and what is kept from it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fibers/clocks/clock_options.hpp"
#include "fibers/posix/program/record.hpp"
#include "tools/command/command_line.hpp"

namespace waitpoint::tools {

struct ProgramConditions {
  std::optional<kernel::ClockOptions> clock;  ///< what computing costs; without one nothing
  std::string clock_text;                     ///< as it was written
  bool isolate = false;                       ///< what would leave the machine fails
  bool trap_rdtsc = false;                    ///< the processor's counter shows virtual time
  bool trap_library = false;                  ///< what the C library waits for within itself is simulated
  bool children = false;                      ///< programs that it starts are simulated too

  void apply_to(posix::Settings& settings) const;
  /// BadInput for programs that they cannot be had for: these files.
  void check(const std::vector<std::string>& programs) const;
  /// As options, each with a blank before it.
  std::string words() const;
};

/// The options as they are written.
class ConditionArguments {
 public:
  void add_to(Command& command);
  /// BadInput where they cannot be meant. `is_repeated`: what does not repeat cannot.
  ProgramConditions conditions(bool is_repeated) const;
  /// The first of them that was given; empty without any.
  std::string first_given() const;

 private:
  std::string clock_;
  std::string children_ = "native";
  bool isolate_ = false, trap_rdtsc_ = false, trap_library_ = false;
};

}  // namespace waitpoint::tools
