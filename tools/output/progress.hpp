// SPDX-License-Identifier: BSD-3-Clause
// Progress of a run: on a terminal, after two seconds, a bar in simulated time, redrawn in place; elsewhere none. Log
// messages of the run are printed through it, so that they do not tear the bar.
//
// Reads the wall clock, only for display.
#pragma once

#include <cstdio>
#include <string_view>

#include "core/time.hpp"

namespace waitpoint::tools {

/// What takes less shows no progress.
inline constexpr double progress_after_s = 2;

/// Seconds of a steady clock with an arbitrary origin.
double wall_clock_s();

class Progress {
 public:
  using Clock = double (*)();

  /// `until` is the end of the bar. Borrows the stream; the caller determines if it is a terminal.
  Progress(std::FILE* stream, bool terminal, Duration until, Clock clock = &wall_clock_s);

  /// Call at every world step: most calls only read the clock.
  void update(Time now, std::size_t goals_reached, std::size_t goals);
  /// A line of the run's log, with its virtual time.
  void log(Time now, std::string_view robot, std::string_view message);
  /// Erases the bar; the next update shows it again.
  void finish();

 private:
  void draw_bar(Time now, std::size_t goals_reached, std::size_t goals, double wall_s);

  std::FILE* stream_;
  bool terminal_;
  Duration until_;
  Clock clock_;
  double start_s_, next_draw_s_;
  bool bar_shown_ = false;
};

}  // namespace waitpoint::tools
