// SPDX-License-Identifier: BSD-3-Clause
// The environment of a program besides its schedule: the cost of computing, and restrictions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fibers/clocks/clock_options.hpp"
#include "fibers/posix/program/record.hpp"
#include "tools/command/command.hpp"

namespace waitpoint::tools {

/// A clock as `--clock` has it; nothing if the text is none.
std::optional<kernel::ClockOptions> parse_clock(const std::string& text);
/// False if it measures real time.
bool repeats(const kernel::ClockOptions& clock);

struct ProgramConditions {
  std::optional<kernel::ClockOptions> clock;  ///< cost of computing; default: none
  std::string clock_text;                     ///< as given
  std::optional<Duration> call_cost;          ///< of a use of a primitive and of reading a clock
  bool isolate = false;                       ///< calls that would leave the machine fail
  bool trap_rdtsc = false;                    ///< the time-stamp counter shows virtual time
  bool strict = false;                        ///< unrepeatable calls end the run
  bool trap_library = false;                  ///< the C library's internal waits are simulated
  std::optional<double> speed;                ///< of virtual time by real time, with partners outside; 0: no limit
  std::optional<Duration> idle_limit;         ///< a run that is idle for so long ends; 0: none does
  bool own_machine = false;                   ///< a network and shared memory of its own
  posix::Medium medium;                       ///< of UDP datagrams between the processes
  std::string delay_text;                     ///< as given
  bool children = true;                       ///< programs that it starts are simulated, too

  void apply_to(posix::Settings& settings) const;
  /// Before these files are started: BadInput if the conditions are impossible for one of them, or not allowed here.
  void check(const std::vector<std::string>& programs) const;
  /// As options, each with a leading space.
  std::string words() const;
};

enum class Repetition { needed, not_needed };

/// Their options. With `needed`, clocks that are not repeatable are BadInput.
void declare_conditions(Command& command, ProgramConditions& conditions, Repetition repetition);

}  // namespace waitpoint::tools
