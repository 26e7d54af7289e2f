// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/session.hpp"

#include <fmt/format.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "tools/command/interruption.hpp"
#include "tools/output/output_file.hpp"
#include "tools/run/run_watchdog.hpp"

namespace waitpoint::tools {
namespace {

constexpr Duration usual_window = std::chrono::milliseconds(100);
constexpr double behind_s_max = 0.2;  // of real time
constexpr Duration second_length = std::chrono::seconds(1);

std::int64_t seconds_begun(Time time) {
  return (time.since_start() + second_length - Duration::from_ns(1)) / second_length;
}

}  // namespace

Session::Session(run::Experiment& experiment, Time until, double speed, Second second)
    : experiment_(experiment),
      until_(until),
      second_(std::move(second)),
      progress_(stderr, isatty(STDERR_FILENO) != 0, until.since_start()),
      pacing_(speed),
      window_(usual_window),
      process_(getpid()) {}

// Before the first window the world has its state of the start.
void Session::take_part(outside::Partners& partners, bool faults_end) {
  partners_ = &partners;
  faults_end_ = faults_end;
  window_ = std::min(usual_window, experiment_.world().description().step);
  partners_->begin(*this);
}

// In short windows, so that it is shown smoothly also at the speed of the wall clock.
void Session::show(view::LiveRun& live) {
  live_ = &live;
  window_ = std::min(usual_window, experiment_.world().description().step);
}

void Session::show_window() {
  live_->after_window(reached_, [] { return interruption() != 0; });
  if (const auto speed = live_->take_speed()) set_speed(*speed);
}

Session::Stop Session::carry_on(Time target, const Enough& enough, const Heed& heed) {
  pacing_.restart(now(), pacing_.speed());
  const double start_s = wall_clock_s();
  const Stop stop = carry_on_in_windows(std::min(target, until_), enough, heed);
  tell_outcomes();
  progress_.finish();
  wall_s_ += wall_clock_s() - start_s;
  return stop;
}

Session::Stop Session::carry_on_in_windows(Time target, const Enough& enough, const Heed& heed) {
  while (!over() && reached_ < target) {
    if (interruption() != 0) return Stop::interrupted;
    if (partners_ != nullptr) partners_->take_in(*this);
    if (over()) break;
    const Time next = std::min(target, Time() + window_ * (reached_.since_start() / window_ + 1));
    end_ = enough ? experiment_.run_before(next, enough) : experiment_.run_before(next);
    end_forked_copy();
    if (experiment_.paused()) return Stop::enough;
    close_window(next);
    if (partners_ != nullptr) partners_->publish(*this);
    if (live_ != nullptr) show_window();
    bool asked = false;
    pacing_.wait_for(next, [&] { return interruption() != 0 || (heed && (asked = heed())); });
    if (partners_ != nullptr) tell_lag();
    if (!over() && (asked || (heed && heed()))) return Stop::asked;
  }
  return over() ? Stop::over : Stop::target;
}

// The run, its terminal and its files are the parent's: exit handlers and buffers must not reach them. But a checkpoint
// of a debugger is the run.
void Session::end_forked_copy() {
  if (getpid() == process_) return;
  if (is_traced()) {
    process_ = getpid();
    OutputFile::take_over();
    return;
  }
  dprintf(STDERR_FILENO, "waitpoint: a process that a task forked returned into the run: it ends here\n");
  syscall(SYS_exit_group, 1);
}

void Session::close_window(Time end) {
  reached_ = end;
  tell_outcomes();
  progress_.update(end, experiment_.goals_reached(), experiment_.goals());
  const bool whole_second = end.since_start() == second_length * (end.since_start() / second_length);
  if (whole_second || over()) second_(seconds_begun(end));
}

void Session::tell_outcomes() {
  const std::vector<run::InterventionOutcome>& outcomes = experiment_.outcomes();
  for (; printed_ < outcomes.size(); ++printed_)
    progress_.log(outcomes[printed_].date, outcomes[printed_].of, outcomes[printed_].text);
}

void Session::tell_lag() {
  const bool behind = pacing_.late_s() > behind_s_max;
  if (behind != is_behind_)
    progress_.log(reached_, "run",
                  behind ? fmt::format("{:.1f} s behind real time", pacing_.late_s()) : "in real time again");
  is_behind_ = behind;
}

void Session::intervene(const std::string& text, const scenario::Location& written) {
  intervene(run::parse_intervention(text, written));
}

void Session::tell(const std::string& of, const std::string& text) { progress_.log(now(), of, text); }

void Session::tell_fault(const std::string& of, const std::string& text) {
  tell(of, text);
  if (faults_end_ && fault_.empty()) fault_ = of + ": " + text;
}

Time Session::intervene(const run::Intervention& intervention, std::optional<Time> date) {
  const Time at = experiment_.intervene(intervention, date);
  const std::string line = run::to_text(at, intervention);
  if (journal_ != nullptr) journal_->write(line);
  if (live_ != nullptr) live_->add_to_journal(line);
  return at;
}

Time Session::now() const { return experiment_.paused() ? experiment_.simulation().global_time() : reached_; }

run::JournalEnd Session::here() const {
  experiment_.gather_records();
  return {now(), experiment_.events(), to_string(experiment_.simulation().digest())};
}

bridge::RunResult Session::result() const {
  bridge::RunResult result = experiment_.result();
  result.wall_s = wall_s_;
  result.lag = pacing_.lag();
  if (partners_ != nullptr) result.outside = partners_->accounts();
  if (partners_ != nullptr) result.outside_unmet = partners_->unmet();
  result.outside_fault = fault_;
  const Time here = end_ == RunEnd::time_reached ? now() : experiment_.simulation().global_time();
  const Time last = experiment_.last_end().value_or(here);
  result.simulated = last.since_start();
  result.real_time_factor = result.wall_s > 0 ? result.simulated.seconds() / result.wall_s : 0;
  return result;
}

}  // namespace waitpoint::tools
