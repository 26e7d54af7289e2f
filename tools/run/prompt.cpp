// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/prompt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>

#include "core/nearest_name.hpp"
#include "core/number_text.hpp"
#include "modules/run/condition.hpp"
#include "modules/scenario/words.hpp"
#include "tools/command/interruption.hpp"
#include "tools/output/recorders.hpp"
#include "tools/run/pacing.hpp"

namespace waitpoint::tools {
namespace {

constexpr const char* help_text = R"(  step [N]                     execute the next event, or the next N
  run [TIME | +SECONDS]        run to that virtual time, or to the end (also: continue)
  until TIME                   the same as run
  until ROBOT.FIGURE >= N      run to the first event after which this holds; figures: goals, collisions, travelled_m, x_m, y_m,
                               stalled; comparisons: < <= == >= >
  go [TIME | +SECONDS]         run, and accept commands meanwhile (on a terminal, run and until do so, too)
  pause                        stop the run; so does Ctrl-C
  speed X                      set the speed to X simulated seconds per second; max: unthrottled
  status                       show the run's time and the state of its robots
  tasks                        list all tasks, with their local times
  idle [S]                     list tasks that have waited without a timeout for S seconds of virtual time (60)
  [at TIME] INTERVENTION       intervene at the world's next step, or at the first one from TIME on:
    request ROBOT MODULE REQUEST [FIELD=VALUE ...]
    move ROBOT X Y [HEADING_DEG]
    obstacle {name: ..., ...}    add a shape as in a scenario, replacing one of the same name
    move-obstacle NAME X Y [HEADING_DEG]
    remove-obstacle NAME
    push NAME FX_N FY_N SECONDS  apply a force to a robot or a loose body of a dynamic world
    seed N                       from now on, draw random numbers and choices as with this seed
    tcl ROBOT COMMAND            evaluate a command of Tcl in the robot's shell
    external ROBOT [KEY=VALUE ...], report ROBOT KEY=VALUE ...
                                 move its body by reports of its position, as from outside
    command ROBOT KEY=VALUE ...  drive its base: v_m_s, w_rad_s, side_m_s, climb_m_s
  quit                         end the run here, with summary and digest
)";

}  // namespace

const Prompt::Named Prompt::commands[] = {
    {"help", &Prompt::help, true},        {"step", &Prompt::step, false},  {"run", &Prompt::run_to, false},
    {"continue", &Prompt::run_to, false}, {"go", &Prompt::go, false},      {"until", &Prompt::until, false},
    {"pause", &Prompt::pause, true},      {"speed", &Prompt::speed, true}, {"status", &Prompt::status, true},
    {"tasks", &Prompt::tasks, true},      {"at", &Prompt::at, true},       {"quit", &Prompt::quit, true},
    {"idle", &Prompt::idle, true},
};

bool Prompt::run() {
  if (terminal_) std::puts("type help for the commands");
  std::string line;
  while (!quit_ && !interrupted_ && !session_.over()) {
    if (terminal_) fmt::print("{:.3f} s> ", session_.now().seconds());
    std::fflush(stdout);
    const LineReader::Result result = lines_.wait(line);
    if (result != LineReader::Result::line) {
      if (terminal_) std::puts("");
      return result == LineReader::Result::end;
    }
    obey(line, false);
  }
  return !interrupted_;
}

void Prompt::obey(std::string_view line, bool running) {
  if (!terminal_) ++written_.line;
  try {
    std::string_view rest = line;
    const std::string word = scenario::take_word(rest, written_);
    if (word.empty() || word.starts_with('#')) return;
    std::vector<std::string_view> known = run::intervention_verbs();
    if (std::find(known.begin(), known.end(), word) != known.end()) {
      session_.intervene(run::parse_intervention(line, written_));
      return;
    }
    for (const Named& named : commands) {
      known.push_back(named.name);
      if (named.name != word) continue;
      if (running && !named.while_running) throw written_.bad("the run is not paused; pause it before '" + word + "'");
      return (this->*named.command)(rest);
    }
    throw written_.bad("unknown command '" + word + "'" + did_you_mean(word, known) + "; help lists them all");
  } catch (const BadInput& error) {
    std::fflush(stdout);
    std::fprintf(stderr, "%s\n", error.what());
  }
}

// Executes commands typed during the run; true to stop it.
bool Prompt::heed() {
  std::string line;
  while (!pause_ && !quit_ && lines_.poll(line) == LineReader::Result::line) obey(line, true);
  std::fflush(stdout);
  return pause_ || quit_;
}

void Prompt::carry_on(Time target, const Session::Enough& enough, bool heeding) {
  pause_ = false;
  const Session::Stop stop =
      session_.carry_on(target, enough, heeding ? Session::Heed([this] { return heed(); }) : nullptr);
  // On a terminal, Ctrl-C returns to the prompt, even if it arrived just after the run had stopped by itself.
  if (terminal_ && interruption() == SIGINT)
    forget_interruption();
  else
    interrupted_ = stop == Session::Stop::interrupted;
  if (stop != Session::Stop::over) tell_place();
}

void Prompt::tell_place() {
  const run::JournalEnd here = session_.here();
  fmt::print("at {} s after {}\n", to_string(here.time), counted(here.events, "event"));
}

void Prompt::help(std::string_view rest) {
  scenario::require_end(rest, written_);
  std::fputs(help_text, stdout);
}

void Prompt::step(std::string_view rest) {
  const std::string word = scenario::take_word(rest, written_);
  scenario::require_end(rest, written_);
  std::uint64_t left = 1;
  if (!word.empty() && (!parse_number(word, left) || left == 0))
    throw written_.bad("expected a number of events, found '" + word + "'");
  if (session_.experiment().ranks() > 1)
    throw written_.bad("expected a run of one process: the events of several are executed at once");
  std::string last;
  carry_on(
      session_.until(),
      [&](const kernel::EventRecord& record) {
        if (--left == 0) last = event_text(record);
        return left == 0;
      },
      false);
  if (!last.empty()) std::puts(last.c_str());
}

void Prompt::run_to(std::string_view rest) { run_to(rest, terminal_); }

void Prompt::run_to(std::string_view rest, bool heeding) {
  const std::string word = scenario::take_word(rest, written_);
  scenario::require_end(rest, written_);
  Time target = session_.until();
  if (!word.empty()) {
    const bool relative = word.starts_with('+');
    const std::optional<Time> time = run::parse_time(relative ? word.substr(1) : word);
    if (!time) throw written_.bad("expected a time in seconds, found '" + word + "'");
    target = relative ? session_.now() + time->since_start() : *time;
    if (target < session_.now()) throw written_.bad(word + " s is past");
  }
  carry_on(target, nullptr, heeding);
}

void Prompt::go(std::string_view rest) { run_to(rest, true); }

void Prompt::until(std::string_view rest) {
  if (rest.find_first_of("<>=") == std::string_view::npos) return run_to(rest);
  const run::Condition condition = run::parse_condition(rest, session_.experiment(), written_);
  if (condition()) return tell_place();
  if (session_.experiment().ranks() == 1)
    return carry_on(
        session_.until(), [&](const kernel::EventRecord&) { return condition(); }, terminal_);
  // Of several processes' events none is the one after which it holds: a step of the world is.
  const Duration step = session_.experiment().world().description().step;
  while (!condition() && !session_.over() && interruption() == 0) session_.carry_on(session_.now() + step);
  interrupted_ = interruption() != 0;
  tell_place();
}

void Prompt::pause(std::string_view rest) {
  scenario::require_end(rest, written_);
  pause_ = true;
}

void Prompt::speed(std::string_view rest) {
  const std::string word = scenario::take_word(rest, written_);
  scenario::require_end(rest, written_);
  double speed = 0;
  if (word != "max" && (!parse_number(word, speed) || !is_speed(speed)))
    throw written_.bad(std::string("expected ") + speeds + ", found '" + word + "'");
  if (session_.has_partners())
    throw written_.bad("expected no change of the speed: partners outside live in real time");
  session_.set_speed(speed);
}

void Prompt::status(std::string_view rest) {
  scenario::require_end(rest, written_);
  tell_place();
  const run::Experiment& experiment = session_.experiment();
  for (std::size_t i = 0; i < experiment.robots().size(); ++i) {
    const bridge::Robot& robot = *experiment.robots()[i];
    const auto& body = experiment.world().body(world::BodyId(i));
    fmt::print("  {}: {} of {} goals, at ({:.3f}, {:.3f}) heading {:.1f} degrees, {:.2f} m travelled, {}{}\n",
               robot.name(), robot.goals_reached(), robot.goals(), body.pose.x, body.pose.y,
               body.pose.heading / exact::pi * 180, body.travelled_m, counted(body.collisions, "collision"),
               body.stalled ? ", stalled" : "");
  }
}

void Prompt::tasks(std::string_view rest) {
  scenario::require_end(rest, written_);
  std::fputs(session_.experiment().tasks().c_str(), stdout);
}

void Prompt::idle(std::string_view rest) {
  constexpr double usual_s = 60, most_s = 1e9;
  double least_s = usual_s;
  if (const std::string word = scenario::take_word(rest, written_);
      !word.empty() && (!parse_number(word, least_s) || !(least_s >= 0 && least_s <= most_s)))
    throw written_.bad("expected seconds, found '" + word + "'");
  scenario::require_end(rest, written_);
  const std::string tasks = session_.experiment().idle(Duration::from_seconds(least_s));
  std::puts(tasks.empty() ? "  none" : tasks.c_str() + 1);
}

void Prompt::at(std::string_view rest) {
  const std::string word = scenario::take_word(rest, written_);
  const std::optional<Time> time = run::parse_time(word);
  if (!time) throw written_.bad("expected a time in seconds, found '" + word + "'");
  session_.intervene(run::parse_intervention(rest, written_), time);
}

void Prompt::quit(std::string_view rest) {
  scenario::require_end(rest, written_);
  quit_ = true;
}

}  // namespace waitpoint::tools
