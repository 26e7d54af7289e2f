// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/explore.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <functional>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/number_text.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "modules/scenario/scenario_reader.hpp"
#include "tools/command/interruption.hpp"
#include "tools/command/program_layer.hpp"
#include "tools/exec/access_obstacles.hpp"
#include "tools/explore/replay/program_replay.hpp"
#include "tools/explore/replay/replay.hpp"
#include "tools/explore/report/failure_report.hpp"
#include "tools/explore/runs/program_target.hpp"
#include "tools/explore/runs/run_with_nodes.hpp"
#include "tools/explore/runs/scene.hpp"
#include "tools/explore/search/discoveries.hpp"
#include "tools/explore/search/search.hpp"
#include "tools/explore/search_json.hpp"
#include "tools/explore/shown_search.hpp"
#include "tools/finding/finding_page.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/output_file.hpp"

namespace waitpoint::tools {
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
int end_search(const ProcessTarget& target, int status, const std::optional<SearchCounts>& counts,
               const ReportedFailure* failure) {
  if (!target.options().json) return status;
  return end_with_json("explore", status, search_json(target.name(), counts, failure));
}

/// The default order has failed, and nothing else is run.
int end_at_once(ProcessTarget& target, SearchProgress& progress, const ProcessFinding& usual, Files& files) {
  const FailureReport report = report_default(target, progress, usual);
  tell(report, files, target.options().json);
  const ReportedFailure failure{usual, report};
  return end_search(target, 1, std::nullopt, &failure);
}

std::string sum(const ProcessTarget& target, const Search& search, double seconds, bool is_interrupted) {
  const std::string all = search.has_drawn() ? "; exhausted, no other ordering exists" : "; exhaustive";
  const char* const natives = target.options().conditions.children ? "" : "; native children in one timing each";
  const std::string unproved =
      search.unproved().empty() ? "" : "; all schedules, but perhaps not all orders: " + search.unproved();
  const std::string scope = search.scope() ? all + *search.scope() + natives : unproved;
  const std::string raced = search.raced() > 0 ? fmt::format(" ({} by a data race alone)", search.raced()) : "";
  const std::string obstacle = words_of(search.obstacle());
  const std::string at_calls = obstacle.empty() ? "" : "; switches at calls only: " + obstacle;
  return fmt::format("{}: {}, {} distinct, {} failed{}, in {:.1f} s ({:.1f} a second){}{}{}\n", target.name(),
                     counted(search.schedules(), "schedule"), search.distinct(), search.failures(), raced, seconds,
                     seconds > 0 ? static_cast<double>(search.schedules()) / seconds : 0,
                     is_interrupted ? "; stopped by a signal" : "", scope, at_calls);
}

// Failures of a graver kind than a data race are analysed without regard to races, which may be in each run.
FailureReport report_of(ProcessTarget& target, SearchProgress& progress, const Discoveries& discoveries) {
  const FailedRun& gravest = *discoveries.gravest();
  const bool is_race = gravest.finding.kind == ProcessFinding::Kind::race;
  if (!is_race) target.ignore_races();
  if (gravest.finding.switch_at == SwitchAt::accesses) {
    target.set_profile(gravest.finding.lesson.profile);
    target.switch_at(SwitchAt::accesses);
  }
  FailureReport result =
      gravest.number ? report(target, progress, gravest) : report_default(target, progress, gravest.finding);
  result.text += discoveries.besides(is_race ? result.races : std::vector<ToldRace>());
  return result;
}

// The default order. A program that is in a loop without a call may wait there for another thread: then accesses are
// switch points of all schedules.
std::optional<ProcessFinding> run_usual(ProcessTarget& target) {
  std::optional<ProcessFinding> usual = target.run_apart({.drawn = false}, {.profile = true});
  const bool may_wait = usual && usual->kind == ProcessFinding::Kind::no_progress &&
                        usual->switch_at == SwitchAt::calls && target.options().switch_at == SwitchAt::automatic &&
                        target.options().snapshots == 0;
  if (!may_wait) return usual;
  target.switch_at(SwitchAt::accesses);
  if (std::optional<ProcessFinding> again = target.run_apart({.drawn = false}, {.profile = true});
      !again || again->passed())
    return again;
  target.switch_at(std::nullopt);
  return usual;
}

// A schedule counts as endless beyond the fixed limit plus this multiple of the default order's time.
constexpr double usual_times_max = 10;

int search(ProcessTarget& target, Files& files) {
  heed_signals();
  target.prepare();
  SearchProgress progress(stderr, isatty(STDERR_FILENO) != 0);
  if (files.viewers() != nullptr) files.viewers()->listen_to(progress);
  target.set_limit(target.options().schedule_limit_s.value_or(0));
  const double usual_start_s = progress.seconds();
  std::optional<ProcessFinding> usual = run_usual(target);
  const double usual_s = progress.seconds() - usual_start_s;
  target.set_limit(
      target.options().schedule_limit_s.value_or(ExploreOptions::usual_schedule_limit_s + usual_times_max * usual_s));
  if (usual) std::fputs(usual->evidence.system_calls.c_str(), stderr);
  Discoveries discoveries(target, progress);
  if (usual && exploration::goes_on_after(usual->kind, target.options().races == Races::report)) {
    discoveries.take({std::nullopt, *usual});
  } else if (usual && !usual->passed() && files.results() == nullptr) {
    return end_at_once(target, progress, *usual, files);
  }
  if (usual) target.set_profile(std::move(usual->lesson.profile));
  Search search(target, progress, discoveries, files.results());
  const double start_s = progress.seconds();
  if (usual) search.run();
  const double seconds = progress.seconds() - start_s;
  if (usual && files.results() != nullptr) files.results()->commit();
  const bool is_interrupted = search.interrupted() || !usual;
  const std::string words = sum(target, search, seconds, is_interrupted);
  write_text(words, target.options().json);
  if (files.viewers() != nullptr) files.viewers()->end(words);
  const FailedRun* const gravest = discoveries.gravest();
  const SearchCounts counts{search.schedules(), search.distinct(), search.failures(),          search.raced(), seconds,
                            is_interrupted,     search.scope(),    words_of(search.obstacle())};
  if (gravest == nullptr) {
    files.leave(target.options());
    return end_search(target, is_interrupted ? 130 : 0, counts, nullptr);
  }
  const FailureReport report = report_of(target, progress, discoveries);
  tell(report, files, target.options().json);
  const ReportedFailure failure{gravest->finding, report};
  return end_search(target, is_interrupted ? 130 : 1, counts, &failure);
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
  const scenario::Scenario scenario = scenario::read_scenario(options.scenario, options.assignments);
  if (scenario.has_nodes()) return explore_program(with_run_as_program(options, scenario));
  begin_with_program_layer(scenario);
  if (!options.replay.empty()) return replay(options, scenario, types);
  return shown([&](view::Channel* viewers) {
    sync::tell_threads_outside();
    Files files(options, viewers);
    Scene scene(scenario, types, options, "");  // a failure is reported with its token
    return search(scene, files);
  });
}

}  // namespace waitpoint::tools
