// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/tcl_shell.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "core/number_text.hpp"
#include "modules/scenario/words.hpp"
#include "modules/tcl/interpreter.hpp"
#include "tools/run/pacing.hpp"

namespace waitpoint::tools {
namespace {

std::string on_one_line(std::string command) {
  for (std::size_t at = 0; (at = command.find('\n', at)) != std::string::npos;)
    command.replace(at, 1, run::ShellCommand::newline);
  return command;
}

}  // namespace

TclShell::TclShell(Session& session, int input, bool terminal)
    : session_(session),
      lines_(input),
      terminal_(terminal),
      written_{terminal ? "prompt" : "standard input", 0},
      robot_(session.experiment().robots().front()->name()) {
  (void)tcl::library("--tcl", 0);
}

// Each command has one result.
std::size_t TclShell::results() const {
  const auto& outcomes = session_.experiment().outcomes();
  return static_cast<std::size_t>(std::count_if(outcomes.begin(), outcomes.end(), [](const auto& outcome) {
    return outcome.is_reply && outcome.text.starts_with("tcl ");
  }));
}

bool TclShell::run() {
  if (terminal_) return run_on_terminal();
  std::string line;
  while (!quit_ && !session_.over()) {
    const LineReader::Result result = lines_.wait(line);
    if (result != LineReader::Result::line) return result == LineReader::Result::end;
    take(line);
    if (results() >= sent_) continue;
    const Session::Stop stop = session_.carry_on(session_.until(), nullptr, [this] { return results() >= sent_; });
    if (stop == Session::Stop::interrupted) return false;
  }
  return true;
}

bool TclShell::run_on_terminal() {
  std::puts("commands of Tcl; .quit ends the run");
  const Session::Stop stop = session_.carry_on(session_.until(), nullptr, [this] {
    std::string line;
    LineReader::Result result = LineReader::Result::nothing;
    while (!quit_ && (result = lines_.poll(line)) == LineReader::Result::line) take(line);
    std::fflush(stdout);
    return quit_ || result == LineReader::Result::end;
  });
  return stop != Session::Stop::interrupted;
}

void TclShell::take(const std::string& line) {
  if (!terminal_) ++written_.line;
  try {
    if (command_.empty() && line.starts_with('.')) return obey(std::string_view(line).substr(1));
    command_ += (command_.empty() ? "" : "\n") + line;
    if (!tcl::library(written_.file, written_.line).is_complete(command_)) return;
    const std::string command = std::exchange(command_, {});
    if (scenario::trimmed(command).empty()) return;
    session_.intervene(run::parse_intervention("tcl " + robot_ + " " + on_one_line(command), written_));
    ++sent_;
  } catch (const BadInput& error) {
    std::fprintf(stderr, "%s\n", error.what());
  }
}

void TclShell::obey(std::string_view line) {
  std::string_view rest = line;
  const std::string word = scenario::take_word(rest, written_);
  if (word == "quit") {
    quit_ = true;
  } else if (word == "robot") {
    const std::string robot = scenario::take_word(rest, written_);
    (void)bridge::index_of(robot, session_.experiment().robots(), written_);
    robot_ = robot;
  } else if (word == "speed") {
    const std::string text = scenario::take_word(rest, written_);
    double speed = 0;
    if (!parse_number(text, speed) || !is_speed(speed))
      throw written_.bad(std::string("expected ") + speeds + ", found '" + text + "'");
    if (session_.has_partners())
      throw written_.bad("expected no change of the speed: partners outside live in real time");
    session_.set_speed(speed);
  } else {
    session_.intervene(run::parse_intervention(line, written_));
  }
}

}  // namespace waitpoint::tools
