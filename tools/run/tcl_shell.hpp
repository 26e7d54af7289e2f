// SPDX-License-Identifier: BSD-3-Clause
// The shell of `waitpoint run --tcl`: commands of Tcl on one robot at a time. Each is an intervention of its own, so
// that a journal repeats them. On a terminal, time passes meanwhile; from elsewhere, each command is awaited and time
// passes only in it, as in `after 1000`.
//
//   COMMAND         further lines are read while it is not complete
//   .robot NAME     the robot of the next commands; at first that of the scenario's first row
//   .speed X        simulated seconds per second
//   .quit           as the end of the input
//   .INTERVENTION   as at the prompt: .move rackham 21 4.5
#pragma once

#include <string>
#include <string_view>

#include "tools/run/line_reader.hpp"
#include "tools/run/session.hpp"

namespace waitpoint::tools {

class TclShell {
 public:
  TclShell(Session& session, int input, bool terminal);

  /// Executes commands until the run is over or left. False if a signal ended it.
  bool run();

 private:
  bool run_on_terminal();
  void take(const std::string& line);
  void obey(std::string_view line);
  std::size_t results() const;

  Session& session_;
  LineReader lines_;
  bool terminal_;
  scenario::Location written_;  // the line being executed
  std::string robot_, command_;
  std::size_t sent_ = 0;  // commands whose results come
  bool quit_ = false;
};

}  // namespace waitpoint::tools
