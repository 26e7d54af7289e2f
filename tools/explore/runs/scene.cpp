// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/scene.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "fibers/explore/report/choice_text.hpp"
#include "fibers/explore/report/reordered_events.hpp"
#include "fibers/explore/report/timeline_recorder.hpp"
#include "fibers/explore/schedules/course.hpp"
#include "fibers/explore/schedules/event_stop.hpp"
#include "fibers/explore/schedules/trail_recorder.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/kernel/visit.hpp"
#include "fibers/sync/report/source_lines.hpp"
#include "fibers/sync/system_calls/system_calls.hpp"
#include "modules/run/expectation.hpp"
#include "tools/command/version.hpp"
#include "tools/explore/runs/floor_frames.hpp"
#include "tools/view/scene.hpp"

namespace waitpoint::tools {
namespace {

using exploration::Narrator;

// Interval at which expectations are checked that a run can no longer meet.
constexpr Duration window = std::chrono::milliseconds(100);
constexpr std::uint32_t steps_of_an_instant_max = 100'000;

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
        const run::ExperimentOptions& options)
      : experiment(scenario, types, options),
        explorer(experiment.simulation().scheduler(), steps_of_an_instant_max),
        narrator(experiment.simulation().scheduler(), explorer) {
    experiment.simulation().scheduler().set_decisions(explorer);
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
  Narrator narrator;
  std::optional<exploration::EventStop> stop;
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
  stage_ =
      std::make_unique<Stage>(scenario_, types_, run::ExperimentOptions{noise(0), kernel::Order::explored, replay_});
  is_left_ = false;
  if (!options_.from) return;
  const RunEnd end = stage_->experiment.run_before(Time() + *options_.from);
  if (end != RunEnd::time_reached)
    throw BadInput("--from", "the run is over at " + to_string(stage_->experiment.simulation().global_time()) + " s");
}

Finding Scene::run(const Plan& plan, const Request& request) {
  if (options_.from) {
    WAITPOINT_CHECK(!is_left_, "a run sets out from mid-run twice in one process");
  } else {
    stage_ = std::make_unique<Stage>(scenario_, types_,
                                     run::ExperimentOptions{noise(plan.number), kernel::Order::explored, replay_});
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
  watch_and_carry_out(plan, request, finding);
  finding.take(explorer.schedule(), explorer.parted());
  finding.order = finding.digest;  // the noise may differ, too
  return finding;
}

void Scene::watch_and_carry_out(const Plan& plan, const Request& request, Finding& finding) {
  Simulation& simulation = stage_->experiment.simulation();
  kernel::Scheduler& scheduler = simulation.scheduler();
  Narrator& narrator = stage_->narrator;
  std::optional<exploration::Profiling> profiling;
  std::optional<exploration::TimelineRecorder> recorder;
  std::optional<exploration::EventLog> log;
  if (request.profile) scheduler.set_watch(&profiling.emplace(finding.profile));
  exploration::Timeline timeline;
  if (request.events) scheduler.set_watch(&recorder.emplace(timeline, &stage_->explorer, request.events_from));
  if (request.log_from) scheduler.set_watch(&log.emplace(finding.log, stage_->explorer, *request.log_from));
  exploration::Trail trail{request.trail.value_or(0), {}};
  std::optional<exploration::TrailRecorder> trail_recorder;
  if (request.trail) scheduler.set_watch(&trail_recorder.emplace(trail, simulation));
  if (request.words || request.decision) scheduler.set_decisions(narrator);
  if (request.decision) narrator.ask_for(*request.decision);
  if (request.stop_before)
    scheduler.set_decisions(stage_->stop.emplace(scheduler, stage_->explorer, *request.stop_before));
  simulation.tell(request.places ? sync::Places::told : sync::Places::left_out);
  std::optional<FloorFrames> floor;
  if (request.page) {
    finding.scene = view::text_of(
        view::scene(scenario_, stage_->experiment,
                    {options_.seed, kernel::Order::explored, options_.limit(scenario_.until), version_line()}));
    floor.emplace(scenario_, stage_->experiment, request.events_from, simulation.global_time());
  }
  carry_out(plan.until, floor ? &*floor : nullptr, finding);
  if (floor) finding.frames = floor->take();
  if (request.profile) finding.system_calls = sync::collected_system_calls();
  scheduler.set_watch(nullptr);
  scheduler.set_decisions(stage_->explorer);
  if (profiling) finding.profile.finish(stage_->explorer.steps());
  finding.tell(narrator.narration(), request.decision.has_value(), request.words);
  if (request.events) finding.tell(timeline, {options_.trace.has_value(), request.page, request.marks()});
  finding.trail = to_text(trail);
  if (request.stop_before) tell_stop(finding);
}

void Scene::tell_stop(Finding& finding) const {
  kernel::Scheduler& scheduler = stage_->experiment.simulation().scheduler();
  kernel::Task* const task = stage_->stop->stopped_before();
  if (task == nullptr) return;
  sync::ReturnAddresses stack(exploration::frames_searched);
  stack.resize(kernel::call_stack(*task, stack.data(), stack.size()));
  const sync::ReturnAddresses stacks[] = {stack};
  finding.end = scheduler.global_time();
  finding.tell(exploration::about_to(*task), sync::user_source_lines(stacks, exploration::frames_shown).front());
}

void Scene::carry_out(Time until, FloorFrames* floor, Finding& finding) {
  run::Experiment& experiment = stage_->experiment;
  const bool is_cut = until < options_.limit(scenario_.until);
  until = std::min(until, options_.limit(scenario_.until));
  Time reached = Time() + options_.from.value_or(Duration());
  RunEnd end = RunEnd::time_reached;
  try {
    while (end == RunEnd::time_reached && reached < until && finding.passed() && !is_stopped()) {
      reached = std::min(until, Time() + window * (reached.since_start() / window + 1));
      end = experiment.run_before(reached);
      if (floor != nullptr) floor->step(std::min(reached, experiment.simulation().global_time()));
      finding.words = joined(run::broken(scenario_.expect, experiment.figures()));
      if (!finding.words.empty()) finding.kind = Finding::Kind::unmet;
      if (sync::has_started_outside_of_virtual_time()) {
        finding.kind = Finding::Kind::exception;
        finding.words = joined({sync::started_outside_of_virtual_time, sync::collected_system_calls()});
      }
    }
    if (finding.passed()) judge(finding, end != RunEnd::time_reached || (judged_at_until_ && !is_cut));
    if (end == RunEnd::deadlock) finding.kind = Finding::Kind::deadlock;
    if (end == RunEnd::no_progress) finding.kind = Finding::Kind::no_progress;
    if (end == RunEnd::deadlock || end == RunEnd::no_progress) finding.words = experiment.simulation().trouble();
  } catch (const std::exception& error) {
    finding.kind = Finding::Kind::exception;
    finding.words = error.what();
    end = RunEnd::ended;
  }
  finding.end = end == RunEnd::time_reached ? reached : experiment.simulation().global_time();
  finding.digest = experiment.simulation().digest().value();
  finding.events = experiment.simulation().scheduler().events();
}

bool Scene::is_stopped() const { return stage_->stop && stage_->stop->stopped_before() != nullptr; }

void Scene::judge(Finding& finding, bool goals_too) const {
  scenario::Expectation expect = scenario_.expect;
  if (!goals_too) {
    expect.all_goals_reached = false;
    expect.goals_reached.reset();
  }
  finding.words = joined(run::unmet(expect, stage_->experiment.result()));
  if (!finding.words.empty()) finding.kind = Finding::Kind::unmet;
}

bridge::RunResult Scene::result() const {
  bridge::RunResult result = stage_->experiment.result();
  result.simulated = stage_->experiment.simulation().global_time().since_start();
  return result;
}

const std::vector<exploration::Told>& Scene::switches() const { return stage_->narrator.narration().switches; }

const exploration::Schedule& Scene::schedule() const { return stage_->explorer.schedule(); }

}  // namespace waitpoint::tools
