// SPDX-License-Identifier: BSD-3-Clause
// Shows how far a run has come: on a terminal a bar in simulated time, redrawn in place; elsewhere a line for every
// simulated minute, the same lines in every run. Messages of the run go through it too, so that they do not tear the
// bar.
//
// The wall clock is read here, for display alone.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string_view>

#include "core/time.hpp"

namespace waitpoint::tools {

/// Seconds of a steady clock, from any beginning.
double wall_clock_s();

class Progress {
 public:
  using Clock = double (*)();

  /// `until` is the end of the bar. The stream is borrowed; whether it is a terminal is the caller's to find out.
  Progress(std::FILE* stream, bool terminal, Duration until, Clock clock = &wall_clock_s);

  /// Meant to be called at every world step: it only reads the clock most of the time.
  void update(Time now, std::size_t goals_reached, std::size_t goals);
  /// A line of the run's log, with its virtual time.
  void log(Time now, std::string_view robot, std::string_view message);
  /// Takes the bar away. Nothing is shown afterwards until the next update.
  void finish();

 private:
  void draw_bar(Time now, std::size_t goals_reached, std::size_t goals, double wall_s);

  std::FILE* stream_;
  bool terminal_;
  Duration until_;
  Clock clock_;
  double start_s_, next_draw_s_;
  Time next_line_;
  bool bar_shown_ = false;
};

}  // namespace waitpoint::tools
