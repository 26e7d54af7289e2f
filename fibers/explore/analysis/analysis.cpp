// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/analysis/analysis.hpp"

#include <algorithm>
#include <utility>

#include "core/number_text.hpp"
#include "fibers/explore/analysis/fewer_switches.hpp"
#include "fibers/explore/analysis/finding_schedules.hpp"

namespace waitpoint::exploration {
namespace {

constexpr Duration shown = std::chrono::seconds(2);

class Analyser {
 public:
  Analyser(Target& target, ProgressListener* progress, const Plan& plan, const Finding& found,
           const AnalysisOptions& options)
      : target_(target), traits_(target.traits()), progress_(progress), options_(options), found_plan_(plan) {
    analysis_.plan = plan;
    analysis_.least = found;
    is_default_ = !plan.drawn && plan.switches.empty() && plan.deviations.empty();
  }

  Analysis run() {
    if (options_.minimize && !is_default_) minimize();
    if (explains()) explain();
    analysis_.finding.note = note();
    // The default order has passed with the target's own noise.
    if (is_noise_ && found_plan_.number != 0) reversed_.passing = Plan{.drawn = false};
    if (options_.page) add_schedules(target_, analysis_.plan, analysis_.least, reversed_, analysis_.finding);
    if (is_default_ || analysis_.least.kind != RunVerdict::Kind::killed) tell_run();
    return std::move(analysis_);
  }

 private:
  void minimize() {
    Trials trials(target_, progress_, traits_.to_minimize);
    const std::size_t found = analysis_.least.switches.size();
    FewerSwitches fewer(trials, found_plan_.number, analysis_.least);
    fewer.run();
    note_gravest(trials);
    is_noise_ = fewer.is_noise();
    analysis_.is_minimized = is_noise_ || fewer.repeats() || traits_.is_cheap;
    if (!analysis_.is_minimized) return;
    analysis_.least = fewer.least();
    analysis_.plan = {.number = fewer.number(), .drawn = false, .deviations = analysis_.least.deviations};
    std::string& text = analysis_.text;
    if (is_noise_) {
      text += traits_.default_fails_too;
      return;
    }
    const std::size_t count = analysis_.least.switches.size();
    text += std::to_string(count) + (count == 1 ? " switch" : " switches") + " away from the default order " +
            (count == 1 ? "fails" : "fail") + ", of " + std::to_string(found) + " that were found (" +
            counted(trials.used(), "run") + ")\n";
    if (traits_.has_noise && fewer.number() == 0 && found_plan_.number != 0) text += "the noise does not matter\n";
  }

  // A scenario would need the same noise.
  bool explains() const {
    if (traits_.is_cheap) return true;
    if (!options_.minimize || analysis_.least.kind == RunVerdict::Kind::killed) return false;
    return is_default_ ? !traits_.has_noise : !analysis_.least.deviations.empty();
  }

  void explain() {
    Trials trials(target_, progress_, traits_.to_explain);
    const LeastFailure failure{analysis_.plan.number, analysis_.least, traits_.latest(analysis_.least)};
    const auto choice = last_choice(target_, trials, failure);
    if (choice) reversed_ = reversed_events(trials, failure, *choice);
    note_gravest(trials);
    if (!choice) return;
    analysis_.finding.choice = choice->words;
    analysis_.text += "the last choice from which it could still have passed" +
                      std::string(is_default_ ? " by deviating from the default order" : "") + ": " + choice->words +
                      "\n" + reversed_.text;
  }

  void note_gravest(const Trials& trials) {
    if (trials.gravest().kind > (analysis_.graver ? *analysis_.graver : analysis_.least).kind)
      analysis_.graver = trials.gravest();
  }

  // Empty if there is a pair.
  std::string note() const {
    if (reversed_.pair) return "";
    if (is_default_ && traits_.has_noise) return "the default order fails, with the scenario's own noise";
    if (is_noise_ && !traits_.is_cheap)
      return "it is the noise, not the order: the passing run has the default order, and its own noise";
    if (!options_.minimize && !traits_.is_cheap) return "--no-minimize: no passing run is sought";
    if (!reversed_.text.empty()) return reversed_.text;
    return reversed_.passing ? no_pair_in_words() : "no passing run was found";
  }

  // Repeats the failing run to describe its switches and its last events.
  void tell_run() {
    const Time from =
        traits_.is_cheap ? Time() : Time() + std::max(Duration(), analysis_.least.end.since_start() - shown);
    WantedEvents events{.from = from, .trace = options_.trace};
    if (!traits_.has_noise)
      events.cause = {analysis_.least.kind == RunVerdict::Kind::deadlock, reversed_.passing.has_value(), order()};
    const auto told = target_.repeat(analysis_.plan, {.words = true, .places = true, .events = events});
    if (!told) return;
    const Evidence& evidence = told->evidence;
    std::string& text = analysis_.text;
    if (!told->passed()) analysis_.words = told->words;
    if (!evidence.cause.empty()) text.insert(0, "cause: " + evidence.cause + "\n");
    text += evidence.details;
    analysis_.races = evidence.races;
    if (!evidence.told.empty()) text += "switches away from the default order:\n" + evidence.told;
    analysis_.finding.steps = evidence.last_events;
    if (!evidence.last_events.empty())
      text += "last events of the tasks (*: switch away from the default order):\n" + evidence.last_events;
    analysis_.trace = evidence.trace;
  }

  std::optional<ReversedOrder> order() const {
    if (!reversed_.pair) return std::nullopt;
    return ReversedOrder{reversed_.pair->failing.event, reversed_.pair->passing.event.task,
                         reversed_.pair->passing.operation};
  }

  Target& target_;
  const TargetTraits traits_;
  ProgressListener* progress_;
  const AnalysisOptions options_;
  const Plan found_plan_;
  Analysis analysis_;
  ReversedEvents reversed_;
  bool is_default_ = false, is_noise_ = false;
};

}  // namespace

Analysis analyse(Target& target, ProgressListener* progress, const Plan& plan, const Finding& found,
                 const AnalysisOptions& options) {
  return Analyser(target, progress, plan, found, options).run();
}

}  // namespace waitpoint::exploration
