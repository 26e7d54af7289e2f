// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/explore.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "fibers/explore/search/search.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/program_layer.hpp"
#include "tools/command/system_confinement.hpp"
#include "tools/exec/access_obstacles.hpp"
#include "tools/explore/replay/program_replay.hpp"
#include "tools/explore/replay/replay.hpp"
#include "tools/explore/report/failure_report.hpp"
#include "tools/explore/runs/program_target.hpp"
#include "tools/explore/runs/run_with_nodes.hpp"
#include "tools/explore/runs/scene.hpp"
#include "tools/explore/search/jobs.hpp"
#include "tools/explore/search/observed_accesses.hpp"
#include "tools/explore/search/results_file.hpp"
#include "tools/explore/search_json.hpp"
#include "tools/explore/shown_search.hpp"
#include "tools/finding/finding_page.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {

using exploration::Discoveries;
using exploration::FailedRun;
using exploration::Search;

namespace {

std::string finding_text(const FailureReport& report) {
  exploration::FindingFile finding = report.finding;
  finding.report = report.text;
  return exploration::to_text(finding);
}

/// What is left of a search, and who looks on.
class Files {
 public:
  /// `viewers`: null if nobody looks on.
  Files(const ExploreOptions& options, view::Channel* viewers) {
    if (viewers != nullptr) viewers_.emplace(*viewers);
    if (options.results) results_.emplace(*options.results);
    if (options.schedule) schedule_.emplace(*options.schedule);
    if (options.trace) trace_.emplace(*options.trace);
    if (options.page) page_.emplace(*options.page);
    if (options.finding) finding_.emplace(*options.finding);
  }

  /// Null if no results are asked for.
  ResultsFile* results() { return results_ ? &*results_ : nullptr; }
  /// Of processes that show the search; null if there are none.
  SearchViewers* viewers() { return viewers_ ? &*viewers_ : nullptr; }
  void write(const FailureReport& report) {
    if (schedule_) {
      schedule_->write(to_text(report.schedule));
      schedule_->commit();
    }
    if (trace_) {
      trace_->write(report.trace);
      trace_->commit();
    }
    if (!page_ && !finding_ && !viewers_) return;
    const std::string text = finding_text(report);
    if (viewers_) viewers_->show(text);
    if (page_) {
      page_->write(page_of_finding(text));
      page_->commit();
    }
    if (finding_) {
      finding_->write(text);
      finding_->commit();
    }
  }
  /// No schedule has failed: nothing is written.
  void leave(const ExploreOptions& options) const {
    for (const auto& [name, file] : {std::pair("--page", options.page), std::pair("--finding", options.finding)})
      if (file) std::fprintf(stderr, "waitpoint: %s: no schedule failed: %s is not written\n", name, file->c_str());
  }

 private:
  std::optional<ResultsFile> results_;
  std::optional<OutputFile> schedule_, trace_, page_, finding_;
  std::optional<SearchViewers> viewers_;
};

void tell(const FailureReport& report, Files& files, bool is_json) {
  write_text(report.text, is_json);  // even if the files cannot be written
  files.write(report);
}

/// Ends a search with its status, and its document if that is wanted.
int end_search(const ProcessTarget& target, int status, const Search* search, double seconds,
               const ReportedFailure* failure) {
  if (!target.options().json) return status;
  return end_with_json("explore", status, search_json(target.name(), search, seconds, failure));
}

/// The default order has failed, and nothing else is run.
int end_at_once(ProcessTarget& target, SearchProgress& progress, const Finding& usual, Files& files) {
  const FailureReport report = report_default(target, progress, usual);
  tell(report, files, target.options().json);
  const ReportedFailure failure{usual, report};
  return end_search(target, 1, nullptr, 0, &failure);
}

// Code whose accesses are no switch points, and are asked for or cannot be.
std::string unexplored_code(const ProcessTarget& target, const Search& search) {
  std::string text;
  if (search.generated_code() > 0)
    text = fmt::format("; not explored: {} of code generated at run time", counted(search.generated_code(), "byte"));
  if (search.schedules() == 0 || !words_of(search.obstacle()).empty()) return text;
  const std::vector<std::string>& asked = target.options().libraries;
  for (std::size_t i = 0; i < asked.size(); ++i)
    if ((search.libraries() >> i & 1) == 0)
      text += "; not explored: " + asked[i] + ", which the program has not loaded before it made a thread";
  return text;
}

std::string sum(const ProcessTarget& target, const Search& search, double seconds, bool is_interrupted) {
  const std::string all = search.has_drawn() ? "; exhausted, no other ordering exists" : "; exhaustive";
  const char* const natives = target.options().conditions.children ? "" : "; native children in one timing each";
  const std::string unproved =
      search.unproved().empty() ? "" : "; all schedules, but perhaps not all orders: " + search.unproved();
  const std::string scope = search.scope() ? all + *search.scope() + natives : unproved;
  const std::string unexplored = unexplored_code(target, search);
  const std::string raced = search.raced() > 0 ? fmt::format(" ({} by a data race alone)", search.raced()) : "";
  const std::string obstacle = words_of(search.obstacle());
  const std::string at_calls = obstacle.empty() ? "" : "; switches at calls only: " + obstacle;
  const auto chance = search.failures() == 0 && !search.scope() ? search.chance_of_news() : std::nullopt;
  const std::string seen = chance ? exploration::to_text(*chance) + "\n" : "";
  return fmt::format("{}: {}, {} distinct, {} failed{}, in {:.1f} s ({:.1f} a second){}{}{}{}\n{}", target.name(),
                     counted(search.schedules(), "schedule"), search.distinct(), search.failures(), raced, seconds,
                     seconds > 0 ? static_cast<double>(search.schedules()) / seconds : 0,
                     is_interrupted ? "; stopped by a signal" : "", scope, at_calls, unexplored, seen);
}

// Failures of a graver kind than a data race are analysed without regard to races, which may be in each run.
FailureReport report_of(ProcessTarget& target, SearchProgress& progress, Discoveries& discoveries) {
  const FailedRun& gravest = *discoveries.gravest();
  const bool is_race = gravest.finding.kind == RunVerdict::Kind::race;
  if (!is_race) target.ignore_races();
  if (gravest.finding.switch_at == SwitchAt::accesses) {
    target.set_profile(gravest.finding.lesson.profile);
    target.switch_at(SwitchAt::accesses);
  }
  FailureReport result =
      gravest.number ? report(target, progress, gravest) : report_default(target, progress, gravest.finding);
  // The noise of its run, if there is one, has no token.
  if (result.graver && !target.traits().has_noise)
    discoveries.take({.number = {}, .finding = *result.graver, .is_of_analysis = true});
  result.text += discoveries.besides(gravest, is_race ? result.races : std::vector<ToldRace>());
  return result;
}

// The default order. A program that is in a loop without a call may wait there for another thread: then accesses are
// switch points of all schedules. Where time is short, a fifth of it tells that it is in a loop.
std::optional<Finding> run_usual(ProcessTarget& target) {
  const ExploreOptions& options = target.options();
  const bool may_switch =
      !options.program.empty() && options.switch_at == SwitchAt::automatic && options.snapshots == 0;
  const double patience_s = std::min(Watchdog::usual_patience_s, options.time_limit_s / 5);
  const bool is_short = may_switch && options.time_limit_s > 0 && patience_s < Watchdog::usual_patience_s;
  if (is_short) target.set_patience(patience_s);
  std::optional<Finding> usual = target.run_apart({.drawn = false}, {.profile = true});
  if (is_short) target.set_patience(Watchdog::usual_patience_s);
  const bool may_wait =
      may_switch && usual && usual->kind == RunVerdict::Kind::no_progress && usual->switch_at == SwitchAt::calls;
  if (!may_wait) return usual;
  target.switch_at(SwitchAt::accesses);
  if (std::optional<Finding> again = target.run_apart({.drawn = false}, {.profile = true}); !again || again->passed())
    return again;
  target.switch_at(std::nullopt);
  return is_short ? target.run_apart({.drawn = false}, {.profile = true}) : usual;
}

// A schedule counts as endless beyond the fixed limit plus this multiple of the default order's time.
constexpr double usual_times_max = 10;

// As in SearchExtent::decided_after.
constexpr std::uint64_t decision_interval = 64;

// Draws of a scenario are never exhausted, as it has too many schedules; a shard does not know those of others; results
// are of as many as asked for.
exploration::SearchExtent extent_of(const ProcessTarget& target, ResultsFile* results) {
  const ExploreOptions& options = target.options();
  const bool is_program = !options.program.empty();
  // Without noise the default order is a single schedule.
  const bool is_one = options.strategy == "fifo" && !target.traits().has_noise;
  exploration::SearchExtent extent{
      .first = options.shard.index - 1,
      .step = options.shard.count,
      .iterations = is_one ? std::min<std::uint64_t>(options.iterations, 1) : options.iterations,
      .may_be_exhausted = is_program && options.strategy != "fifo" && options.shard.count == 1 && results == nullptr,
      .learns = is_program,
      .has_sample = is_program,
      .decided_after = decision_interval};
  if (results != nullptr)
    extent.each = [results](std::uint64_t number, const Finding& finding) { results->take(number, finding); };
  return extent;
}

constexpr int status_nothing_ran = 3;

// No schedule has come to its end, and none has failed.
std::string why_nothing_ran(const ProcessTarget& target, bool has_usual) {
  const ExploreOptions& options = target.options();
  if (!target.time_limit().is_over())
    return fmt::format("waitpoint: --shard: none of its schedules is among the first {} of --iterations\n",
                       options.iterations);
  return fmt::format("waitpoint: --time-limit: {} has ended within {} s: nothing is known of {}\n",
                     has_usual ? "no schedule but the default order" : "not even the default order",
                     number_text(options.time_limit_s), target.name());
}

// A failure is reported in the time that is left, or in another second.
void begin_report(ProcessTarget& target) {
  constexpr double least_s = 0.8;
  if (target.options().time_limit_s > 0)
    target.set_time_limit(exploration::TimeLimit(std::max(target.time_limit().left_s(), least_s)));
}

// All schedules at calls are all orders if threads share memory by calls alone.
void check_accesses(ProcessTarget& target, Search& search) {
  if (!search.is_exhausted_at_calls()) return;
  const ObservedAccesses observed = observe_accesses(target, search.failures() == 0);
  if (!observed.conflict.empty()) return search.doubt(observed.conflict);
  if (observed.obstacle == AccessObstacle::none && observed.schedules > 0)
    return search.assume(fmt::format(", the program's own code shares no other memory in {} with accesses observed",
                                     counted(observed.schedules, "schedule")));
  const std::string why = words_of(observed.obstacle);
  search.assume(", if threads share memory by calls alone (accesses were not observed" +
                (why.empty() ? ")" : ": " + why + ")"));
}

int search(ProcessTarget& target, Files& files) {
  heed_signals();
  const exploration::TimeLimit time_limit(target.options().time_limit_s);
  target.set_time_limit(time_limit);
  target.prepare();
  SearchProgress progress(stderr, isatty(STDERR_FILENO) != 0);
  if (files.viewers() != nullptr) files.viewers()->listen_to(progress);
  target.set_limit(target.options().schedule_limit_s.value_or(0));
  const double usual_start_s = progress.seconds();
  std::optional<Finding> usual = run_usual(target);
  const double usual_s = progress.seconds() - usual_start_s;
  target.set_limit(
      target.options().schedule_limit_s.value_or(ExploreOptions::usual_schedule_limit_s + usual_times_max * usual_s));
  if (usual) std::fputs(usual->evidence.system_calls.c_str(), stderr);
  Discoveries discoveries(target, target.options(), &progress);
  if (usual && exploration::goes_on_after(usual->kind, target.options().races == Races::report)) {
    discoveries.take({std::nullopt, *usual});
  } else if (usual && !usual->passed() && files.results() == nullptr) {
    begin_report(target);
    return end_at_once(target, progress, *usual, files);
  }
  if (usual) target.set_profile(std::move(usual->lesson.profile));
  Jobs jobs(target);
  Search search(target.options(), extent_of(target, files.results()), time_limit, jobs, discoveries, &progress);
  const double start_s = progress.seconds();
  if (usual && files.results() != nullptr) files.results()->begin(target);
  if (usual) search.run();
  progress.finish();
  const double seconds = progress.seconds() - start_s;
  if (usual && files.results() != nullptr) files.results()->commit();
  check_accesses(target, search);
  const bool is_interrupted = interruption() != 0;
  const std::string words = sum(target, search, seconds, is_interrupted);
  write_text(words, target.options().json);
  if (files.viewers() != nullptr) files.viewers()->end(words);
  const FailedRun* const gravest = discoveries.gravest();
  if (gravest == nullptr) {
    files.leave(target.options());
    const bool has_run = search.schedules() > 0;
    if (!has_run && !is_interrupted) std::fputs(why_nothing_ran(target, usual.has_value()).c_str(), stderr);
    return end_search(target, is_interrupted ? 130 : has_run ? 0 : status_nothing_ran, &search, seconds, nullptr);
  }
  begin_report(target);
  const FailureReport report = report_of(target, progress, discoveries);
  tell(report, files, target.options().json);
  const ReportedFailure failure{gravest->finding, report};
  return end_search(target, is_interrupted ? 130 : 1, &search, seconds, &failure);
}

}  // namespace

int explore(const ExploreOptions& options, std::span<const genom::ModuleType> types) {
  const auto shown = [&](const std::function<int(view::Channel*)>& begin) {
    if (!options.serve) return begin(nullptr);
    return show_search(options, [&](view::Channel& viewers) { return begin(&viewers); });
  };
  const auto explore_program = [&shown](const ExploreOptions& of_program) {
    if (!of_program.replay.empty()) return replay_program(of_program);
    return shown([&](view::Channel* viewers) {
      Files files(of_program, viewers);
      ProgramTarget program(of_program);
      return search(program, files);
    });
  };
  if (!options.program.empty()) return explore_program(options);
  const scenario::Scenario scenario = scenario::read_scenario(options.scenario, options.assignments, options.allowed);
  if (scenario.has_nodes()) return explore_program(with_run_as_program(options, scenario));
  begin_with_program_layer(scenario);
  if (!options.replay.empty()) return replay(options, scenario, types);
  return shown([&](view::Channel* viewers) {
    sync::tell_threads_outside();
    Files files(options, viewers);
    Scene scene(scenario, types, options, "");  // a failure is reported with its token
    confine_to_listed_files();
    return search(scene, files);
  });
}

}  // namespace waitpoint::tools
