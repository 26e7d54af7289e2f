// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/campaign.hpp"

#include <malloc.h>

#include <cerrno>
#include <chrono>
#include <fstream>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "fibers/explore/analysis/analysis.hpp"
#include "fibers/explore/body_watch.hpp"
#include "fibers/explore/environment.hpp"
#include "fibers/explore/play.hpp"
#include "fibers/explore/races/races.hpp"
#include "fibers/explore/search/failed_run.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/kernel/run.hpp"

namespace waitpoint::exploration {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t runs_to_minimize = 200'000, runs_to_explain = 20'000;

// Identifies the result of a run: equal for two runs of one schedule.
std::uint64_t number_of(const RunVerdict& verdict) {
  return Digest::mix(verdict.digest) ^ static_cast<std::uint64_t>(verdict.passed());
}

// The token to replay, or that of the campaign's schedules, without their numbers.
Token first_token(const ExploreOptions& options, std::uint32_t call) {
  if (!options.replay.empty()) return read_token(options.replay);
  return {call, 0, options.strategy, options.seed, 0, {}, {}, options.memory};
}

std::string title_of(const ExternalChecks* checks) {
  const std::string name = checks != nullptr ? checks->name() : "";
  return name.empty() ? program_invocation_short_name : name;
}

}  // namespace

Campaign::Campaign(ExternalChecks* checks, std::function<void()> body, const ExploreOptions& options,
                   std::uint32_t call)
    : options_(options),
      call_(call),
      title_(title_of(checks)),
      command_(command_line(checks)),
      body_(std::move(body), checks, options.until, options.steps_max, options.memory),
      target_(body_, title_, runs_to_minimize, runs_to_explain, command_),
      supervisor_({.explored = -1,
                   .token = first_token(options, call),
                   .replay = "replay: WAITPOINT_REPLAY=",
                   .after = " " + command_,
                   .run = [this](const Token& token) { return number_of(play(token)); },
                   .limit_s = options.schedule_limit_s.value_or(ExploreOptions::usual_schedule_limit_s)}),
      runs_(body_, options_, profile_, supervisor_),
      discoveries_(target_, options_, nullptr, call),
      time_limit_(options.time_limit_s),
      search_(options_,
              {.iterations = options.iterations, .may_be_exhausted = options.strategy != "fifo", .has_sample = true},
              time_limit_, runs_, discoveries_, nullptr) {
  if (options.races == Races::ignore) body_.ignore_races();
}

ExploreReport Campaign::run() {
  const Clock::time_point start = Clock::now();
  if (begins_well()) search();
  if (const FailedRun* const gravest = discoveries_.gravest();
      gravest != nullptr && (report_.text.empty() || has_failed())) {
    report_.failed_at = gravest->number.value_or(0);
    tell(*gravest, name_of(*gravest, options_), token_of(*gravest, options_, call_));
  }
  report_.races = discoveries_.races();
  report_.passed = report_.text.empty();
  report_.schedules = search_.schedules();
  report_.distinct = search_.distinct();
  if (report_.passed && report_.scope.empty()) report_.chance_of_news = search_.chance_of_news();
  report_.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return report_;
}

// Runs the default order twice: for the profile, and to check that the body repeats.
bool Campaign::begins_well() {
  supervisor_.begin_default();
  const RunVerdict first = take_profile(body_, profile_);
  usual_digest_ = first.digest;
  usual_kind_ = first.kind;
  search_.count_default(first);
  judge_default(first);
  if (!has_failed()) judge_default(take_timeline(body_, usual_));
  if (!has_failed()) report_.text = difference_to_the_first();
  if (!has_failed()) look_for_leaks();
  supervisor_.pause();
  return report_.text.empty() && !has_failed();
}

// A run in the default order beside the search: its failure is one of the campaign.
void Campaign::judge_default(const RunVerdict& verdict) {
  if (!verdict.passed()) discoveries_.take({std::nullopt, runs_.finding_of(verdict)});
}

// In a way that ends the campaign.
bool Campaign::has_failed() const {
  const FailedRun* const gravest = discoveries_.gravest();
  return gravest != nullptr && !goes_on_after(gravest->finding.kind, options_.races == Races::report);
}

void Campaign::search() {
  races::note_unlearned(false);
  races::forget_left_out_values();
  search_.run();
  supervisor_.pause();
  if (has_failed()) return;
  if (search_.scope()) {
    report_.scope = (search_.has_drawn() ? "exhausted, no other ordering exists" : "all schedules") + *search_.scope();
    report_.complete = search_.is_complete();
  }
  Fifo usual;
  const RunVerdict last = body_.run(usual);
  judge_default(last);
  if (!has_failed() && last.digest != usual_digest_) {
    report_.text = difference_to_the_first();
    if (report_.text.empty())
      report_.text =
          "the body leaks state from one schedule into the next: the default order differs from its first run";
  }
}

// The heap bytes that the default order allocates and does not free: the average of several runs, after others that
// fill the allocator's caches.
void Campaign::look_for_leaks() {
  constexpr std::size_t repeats = 16;
  constexpr std::uint32_t short_body = 10'000;  // in switch points: a longer body runs too seldom for a leak to matter
  if (profile_.steps > short_body) return;
  Fifo usual;
  std::size_t in_use[2] = {};
  for (std::size_t& bytes : in_use) {
    for (std::size_t i = 0; i < repeats; ++i) {
      supervisor_.begin_default();
      judge_default(body_.run(usual));
      if (has_failed() || time_limit_.is_over()) return;
    }
    bytes = mallinfo2().uordblks;
  }
  if (in_use[1] > in_use[0]) report_.leaked_bytes = (in_use[1] - in_use[0]) / repeats;
}

// Compares with the first run of the default order.
std::string Campaign::difference_to_the_first() {
  const Timeline& before = usual_;
  Timeline after;
  judge_default(take_timeline(body_, after));
  for (std::size_t i = 0; i < before.events.size() || i < after.events.size(); ++i) {
    const auto text = [&](const Timeline& timeline) {
      if (i >= timeline.events.size()) return std::string("the end");
      const TimelineEvent& event = timeline.events[i];
      return timeline.tasks[event.task].title + " " + name(event.operation) + " " + timeline.object(event.object);
    };
    if (text(before) != text(after))
      return "the body leaks state from one schedule into the next: in the default order, event " + std::to_string(i) +
             " was '" + text(before) + "' at first and is '" + text(after) + "' now";
  }
  return "";
}

Trail Campaign::trail_of(const Finding& finding, std::uint32_t log_spacing) {
  const Finding again = body_.repeat({.drawn = false, .deviations = finding.deviations}, {.trail = log_spacing});
  Trail trail;
  (void)read_trail(again.evidence.trail, trail);
  return trail;
}

std::string Campaign::replay_by(const Token& token, const Finding& finding) {
  return to_text_with(token, trail_of(finding, log_spacing_for(finding.events)));
}

// True if a fresh process gets the same result by the failure's schedule. There is none under a debugger: then true is
// assumed.
bool Campaign::is_reproducible(const Finding& finding) {
  const std::optional<std::uint64_t> fresh =
      supervisor_.outcome_when_fresh(token_by_deviations(finding, options_, call_));
  return !fresh || *fresh == number_of(finding);
}

void Campaign::report_irreproducible(const FailedRun& found, const std::string& which) {
  supervisor_.pause();
  report_.schedule = {found.finding.lesson.choices, found.finding.switches};
  const Finding again = body_.repeat({.drawn = false, .deviations = found.finding.deviations}, {.places = true});
  report_.text =
      which + " failed: " + (again.passed() ? found.finding : again).words +
      "\nnot reproducible: in a fresh process the same schedule gives another run. The body leaks state from one "
      "schedule into the next, or reads a clock or random numbers that are not simulated; there is no replay line";
}

// A failure of another kind is analysed without regard to races, which may be in each run. Races that are not part of
// the failure come last.
void Campaign::tell(const FailedRun& found, const std::string& which, const Token& token) {
  const bool is_race = found.finding.kind == RunVerdict::Kind::race;
  if (!is_race) body_.ignore_races();
  const bool is_first = !found.number && found.finding.kind == usual_kind_;
  if (!is_first && !is_reproducible(found.finding)) return report_irreproducible(found, which);
  supervisor_.begin_minimizing(found.number.value_or(0), found.enumeration, found.finding.words);
  const std::string file = finding_file(), trace = trace_file();
  const AnalysisOptions wanted{.minimize = options_.minimize, .page = !file.empty(), .trace = !trace.empty()};
  Analysis analysis =
      analyse(target_, nullptr, {.drawn = false, .deviations = found.finding.deviations}, found.finding, wanted);
  if (analysis.graver) discoveries_.take({.number = {}, .finding = *analysis.graver, .is_of_analysis = true});
  const Finding& least = analysis.least;
  report_.schedule = body_.explorer().schedule();  // of the last run of the analysis, by the least plan
  // The runs in between may have leaked state, too.
  if (!is_first && !is_reproducible(least)) return report_irreproducible(found, which);
  report_.replay = replay_by(token_by_deviations(least, options_, call_), least);
  const bool is_shortest = report_.replay.size() <= token_length_max;
  if (!is_shortest) report_.replay = replay_by(token, found.finding);
  supervisor_.pause();
  std::string& text = report_.text;
  const std::string words = analysis.words.empty() ? least.words : analysis.words;
  text = which + " failed: " + words + "\n";
  if (least.switches.empty()) text += "the default order fails\n";
  text += analysis.text;
  if (!trace.empty()) {
    std::ofstream out(trace);
    out << analysis.trace;
    if (!out.flush()) text += "waitpoint: WAITPOINT_TRACE: cannot write to '" + trace + "'\n";
  }
  if (!is_shortest && !token.strategy.empty() && least.switches != found.finding.switches)
    text += "too many switches for one line: the replay line repeats the run as it was found, with " +
            std::to_string(found.finding.switches.size()) + "\n";
  text += "replay: " + target_.replay_command(least, report_.replay);
  if (std::string others = discoveries_.besides(found, is_race ? analysis.races : std::vector<ToldRace>());
      !others.empty()) {
    others.pop_back();
    text += "\n" + others;
  }
  if (file.empty()) return;
  analysis.finding.title = title_;
  analysis.finding.seed = options_.seed;
  analysis.finding.schedule = which;
  analysis.finding.failure = words;
  write_finding(file, std::move(analysis.finding));
}

// With the commands and the text of the report, which must be complete.
void Campaign::write_finding(const std::string& file, FindingFile finding) {
  finding.replay = target_.replay_command({}, report_.replay);
  finding.debug = "WAITPOINT_REPLAY=" + report_.replay + " waitpoint gdb -- " + command_;
  finding.report = report_.text;
  std::ofstream out(file);
  out << to_text(finding);
  if (!out.flush()) report_.text += "\nwaitpoint: WAITPOINT_FINDING: cannot write to '" + file + "'";
}

// For a written-out schedule no other is run, so that a debugger stops in this one only; but shared memory must be
// learned.
RunVerdict Campaign::play(const Token& token) {
  if (!token.strategy.empty() || races::present()) (void)take_profile(body_, profile_);
  return exploration::play(body_, token, profile_);
}

// The event of a token's run before which that decision is made.
std::string Campaign::event_at(const Token& token, std::uint32_t decision) {
  std::string text;
  Played played{.deviations = token.deviations};
  played.stop_at = decision;
  body_.run_up_to(played, [&] {
    text = "event " + std::to_string(kernel::events(body_.simulation().scheduler())) + ", at " +
           to_string(body_.simulation().global_time()) + " s";
  });
  return text;
}

// The difference of the run from the token's; empty if there is none.
std::string Campaign::difference_to(const Token& token, const RunVerdict& verdict) {
  const std::vector<Decision> decisions = body_.explorer().schedule().decisions;
  for (const Deviation& deviation : token.deviations) {
    const std::string which = "choice " + std::to_string(deviation.decision);
    if (deviation.decision >= decisions.size())
      return which + " was not reached: the run diverged and ended after event " + std::to_string(verdict.events) +
             ", at " + to_string(verdict.end) + " s";
    // Without that alternative, the explorer takes the last or the usual one.
    if (deviation.chosen >= decisions[deviation.decision].count)
      return which + " has only " + std::to_string(decisions[deviation.decision].count) + " alternatives, not number " +
             std::to_string(deviation.chosen) + ": the run diverged at " + event_at(token, deviation.decision);
  }
  if (token.digest == 0) return verdict.passed() ? "the recorded run ended its process, this one passed" : "";
  if (token.digest == token_digest(verdict.digest)) return "";
  std::string digests = "it had " + counted(verdict.events, "event") + ", and its digest begins with " +
                        digest_text(token_digest(verdict.digest)) + ", the token's with " + digest_text(token.digest);
  if (token.trail.marks.empty()) return digests;
  const Finding finding{verdict, "", {}, {}, body_.explorer().schedule().deviations(), {}, {}};
  return digests + ": the run diverged " + parting(token.trail, trail_of(finding, token.trail.log_spacing));
}

ExploreReport Campaign::replay(const Token& token) {
  options_.minimize = false;
  supervisor_.begin_replay();
  const RunVerdict verdict = play(token);
  report_.schedules = 1;
  report_.distinct = 1;
  report_.failed_at = token.number;
  std::optional<FailedRun> found;
  if (!verdict.passed()) found = {token.number, runs_.finding_of(verdict)};
  std::string difference = difference_to(token, verdict);
  if (!difference.empty()) {
    difference = "the token belongs to another run: " + difference + "; the program or the test has changed";
    if (has_replay_variable()) throw BadInput(options_.replay, difference);
  }
  if (found) tell(*found, "the replayed schedule", token);
  report_.text = difference + (difference.empty() || verdict.passed() ? "" : "\n") + report_.text;
  report_.passed = report_.text.empty();
  return report_;
}

}  // namespace waitpoint::exploration
