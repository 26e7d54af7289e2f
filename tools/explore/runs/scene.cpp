// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/scene.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fibers/explore/schedules/course.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "modules/run/expectation.hpp"
#include "tools/command/version.hpp"
#include "tools/explore/runs/floor_frames.hpp"
#include "tools/view/scene.hpp"

namespace waitpoint::tools {
namespace {

// Interval at which expectations are checked that a run can no longer meet.
constexpr Duration window = std::chrono::milliseconds(100);

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

bool is_of_goals(const std::string& property) { return property.starts_with("goals_reached="); }

}  // namespace

struct Scene::Stage {
  Stage(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types,
        const run::ExperimentOptions& options, std::uint32_t steps_max)
      : experiment(scenario, types, options), explorer(experiment.simulation().scheduler(), steps_max) {
    kernel::set_decisions(experiment.simulation().scheduler(), explorer);
    explorer.begin(*strategy);
  }
  // Unwinds while the explorer still exists.
  ~Stage() { experiment.unwind(); }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;

  run::Experiment experiment;
  std::unique_ptr<exploration::Strategy> strategy = std::make_unique<exploration::Fifo>();
  Plan plan;  // the explorer borrows its switches
  exploration::Explorer explorer;
  std::optional<exploration::EvidenceRecorder> recording;  // of the present or last run
};

Scene::Scene(const scenario::Scenario& scenario, std::span<const genom::ModuleType> types,
             const ExploreOptions& options, std::string replay)
    : scenario_(scenario),
      types_(types),
      options_(options),
      replay_(std::move(replay)),
      judged_at_until_(options.limit(scenario.until) >= Time() + scenario.until ||
                       std::any_of(options.properties.begin(), options.properties.end(), is_of_goals)) {
  sync::collect_system_calls();
}

Scene::~Scene() = default;

std::uint64_t Scene::noise(std::uint64_t number) const {
  return number == 0 || options_.from ? options_.seed : Digest::mix(options_.seed ^ Digest::mix(number));
}

void Scene::prepare() {
  // Runs from the beginning make their own stage, each with its own noise; but errors of the scenario must be reported
  // now.
  stage_ = std::make_unique<Stage>(
      scenario_, types_, run::ExperimentOptions{noise(0), kernel::Order::explored, replay_}, options_.steps_max);
  is_left_ = false;
  if (!options_.from) return;
  const RunEnd end = stage_->experiment.run_before(Time() + *options_.from);
  if (end != RunEnd::time_reached)
    throw BadInput("--from", "the run is over at " + to_string(stage_->experiment.simulation().global_time()) + " s");
}

Finding Scene::run(const Plan& plan, const WantedEvidence& wanted) {
  if (options_.from) {
    WAITPOINT_CHECK(!is_left_, "a run sets out from mid-run twice in one process");
  } else {
    stage_ = std::make_unique<Stage>(scenario_, types_,
                                     run::ExperimentOptions{noise(plan.number), kernel::Order::explored, replay_},
                                     options_.steps_max);
  }
  is_left_ = true;
  exploration::Explorer& explorer = stage_->explorer;
  exploration::Course course{plan.drawn ? options_.strategy : "", options_.seed, plan.number, {}};
  if (!plan.drawn && plan.at_random_from) {
    course.number = plan.attempt;
    course.at_random_from = plan.at_random_from;
  }
  stage_->strategy = exploration::begin_course(course, explorer, profile_);
  stage_->plan = plan;
  sync::forget_started();
  explorer.begin(*stage_->strategy, {.switches = stage_->plan.switches, .deviations = stage_->plan.deviations});
  Finding finding;
  record_and_carry_out(plan, wanted, finding);
  finding.take(explorer.schedule(), explorer.parted());
  finding.order = finding.digest;  // the noise may differ, too
  return finding;
}

exploration::TargetTraits Scene::traits() const {
  exploration::TargetTraits traits = ProcessTarget::traits();
  traits.has_noise = true;
  traits.default_fails_too =
      "it is the noise, not the order: with the noise of this schedule the default order fails too\n";
  return traits;
}

void Scene::record_and_carry_out(const Plan& plan, const WantedEvidence& wanted, Finding& finding) {
  Simulation& simulation = stage_->experiment.simulation();
  exploration::EvidenceRecorder& recording = stage_->recording.emplace(wanted, simulation, stage_->explorer, finding);
  simulation.tell(wanted.places ? sync::Places::told : sync::Places::left_out);
  std::optional<FloorFrames> floor;
  if (wanted.events && wanted.events->page) {
    finding.evidence.scene = view::text_of(
        view::scene(scenario_, stage_->experiment,
                    {options_.seed, kernel::Order::explored, options_.limit(scenario_.until), version_line()}));
    floor.emplace(scenario_, stage_->experiment, wanted.events->from, simulation.global_time());
  }
  carry_out(plan.until, recording, floor ? &*floor : nullptr, finding);
  if (floor) finding.evidence.frames = floor->take();
  if (wanted.profile) finding.evidence.system_calls = sync::collected_system_calls();
  recording.finish();
}

void Scene::carry_out(Time until, const exploration::EvidenceRecorder& recording, FloorFrames* floor,
                      Finding& finding) {
  run::Experiment& experiment = stage_->experiment;
  const bool is_cut = until < options_.limit(scenario_.until);
  until = std::min(until, options_.limit(scenario_.until));
  Time reached = Time() + options_.from.value_or(Duration());
  RunEnd end = RunEnd::time_reached;
  try {
    while (end == RunEnd::time_reached && reached < until && finding.passed() && !recording.has_stopped()) {
      reached = std::min(until, Time() + window * (reached.since_start() / window + 1));
      end = experiment.run_before(reached);
      if (floor != nullptr) floor->step(std::min(reached, experiment.simulation().global_time()));
      finding.words = joined(run::broken(scenario_.expect, experiment.figures()));
      if (!finding.words.empty()) finding.kind = RunVerdict::Kind::unmet;
      if (sync::has_started_outside_of_virtual_time()) {
        finding.kind = RunVerdict::Kind::exception;
        finding.words = joined({sync::started_outside_of_virtual_time, sync::collected_system_calls()});
      }
    }
    if (finding.passed()) judge(finding, end != RunEnd::time_reached || (judged_at_until_ && !is_cut));
    if (end == RunEnd::deadlock) finding.kind = RunVerdict::Kind::deadlock;
    if (end == RunEnd::no_progress) finding.kind = RunVerdict::Kind::no_progress;
    if (end == RunEnd::deadlock || end == RunEnd::no_progress) finding.words = experiment.simulation().trouble();
  } catch (const std::exception& error) {
    finding.kind = RunVerdict::Kind::exception;
    finding.words = error.what();
    end = RunEnd::ended;
  }
  finding.end = end == RunEnd::time_reached ? reached : experiment.simulation().global_time();
  finding.digest = experiment.simulation().digest().value();
  finding.events = kernel::events(experiment.simulation().scheduler());
}

void Scene::judge(Finding& finding, bool goals_too) const {
  scenario::Expectation expect = scenario_.expect;
  if (!goals_too) {
    expect.all_goals_reached = false;
    expect.goals_reached.reset();
  }
  finding.words = joined(run::unmet(expect, stage_->experiment.result()));
  if (!finding.words.empty()) finding.kind = RunVerdict::Kind::unmet;
}

bridge::RunResult Scene::result() const {
  bridge::RunResult result = stage_->experiment.result();
  result.simulated = stage_->experiment.simulation().global_time().since_start();
  return result;
}

const std::vector<exploration::Told>& Scene::switches() const { return stage_->recording->narration().switches; }

const exploration::Schedule& Scene::schedule() const { return stage_->explorer.schedule(); }

}  // namespace waitpoint::tools
