// SPDX-License-Identifier: BSD-3-Clause
// The prompt of `waitpoint run --interactive`: one command per line, see help_text, from a terminal or a pipe. A line
// that cannot be parsed gets one line of error and has no effect.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tools/run/line_reader.hpp"
#include "tools/run/session.hpp"

namespace waitpoint::tools {

class Prompt {
 public:
  /// On a terminal, commands are also accepted during a run; from elsewhere only during `go`.
  Prompt(Session& session, int input, bool terminal)
      : session_(session), lines_(input), terminal_(terminal), written_{terminal ? "prompt" : "standard input", 0} {}

  /// Executes commands until the run is over or left. False if a signal ended it.
  bool run();

 private:
  using Command = void (Prompt::*)(std::string_view rest);
  struct Named {
    std::string_view name;
    Command command;
    bool while_running;
  };
  static const Named commands[];

  void obey(std::string_view line, bool running);
  bool heed();
  void carry_on(Time target, const Session::Enough& enough, bool heeding);
  void run_to(std::string_view rest, bool heeding);
  void tell_place();

  void help(std::string_view rest);
  void step(std::string_view rest);
  void go(std::string_view rest);
  void run_to(std::string_view rest);
  void until(std::string_view rest);
  void pause(std::string_view rest);
  void speed(std::string_view rest);
  void status(std::string_view rest);
  void tasks(std::string_view rest);
  void idle(std::string_view rest);
  void at(std::string_view rest);
  void quit(std::string_view rest);

  Session& session_;
  LineReader lines_;
  bool terminal_;
  scenario::Location written_;  // the line being executed
  bool pause_ = false;          // requested during the run
  bool quit_ = false;
  bool interrupted_ = false;
};

}  // namespace waitpoint::tools
