// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/outputs.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "fibers/kernel/fault_reports.hpp"
#include "fibers/sync/post_mortem.hpp"
#include "modules/run/plan.hpp"
#include "tools/output/picture.hpp"
#include "tools/output/summary.hpp"
#include "tools/record/formats.hpp"

namespace waitpoint::tools {
namespace {

Outputs* of_this_run = nullptr;

std::string picture_of(const run::Experiment& experiment, const bridge::RunResult& result) {
  const world::WorldDescription& world = experiment.world().description();
  std::vector<world::Obstacle> shown = world.obstacles, meshes = run::meshes_on_plan(world);
  shown.insert(shown.end(), meshes.begin(), meshes.end());
  return picture_svg(shown, result);
}

}  // namespace

Outputs::Outputs(const RunOptions& options, const scenario::Scenario& scenario) : seed_(options.seed) {
  if (options.summary) summary_.emplace(*options.summary);
  if (options.picture) picture_.emplace(*options.picture);
  if (options.digests) digests_.emplace(*options.digests);
  if (options.events) events_.emplace(*options.events);
  if (options.record) recording_ = make_recording(*options.record, scenario);
  if (!options.trajectory) return;
  std::vector<std::string> names;
  for (const scenario::RobotScenario& robot : scenario.robots) names.push_back(robot.name);
  trajectory_.emplace(*options.trajectory, names);
}

Outputs::~Outputs() {
  if (of_this_run != this) return;
  of_this_run = nullptr;
  kernel::set_post_mortem(sync::write_call_stack);
}

void Outputs::watch(run::Experiment& experiment) {
  experiment_ = &experiment;
  of_this_run = this;
  kernel::set_post_mortem(complete_after_death);
  if (events_) events_->watch(experiment.simulation());
  if (!recording_) return;
  recording_->begin(experiment);
  experiment.set_observer([this, &experiment](Time now) { recording_->observe(experiment, now); });
}

void Outputs::write(run::Experiment& experiment, const bridge::RunResult& result) {
  if (summary_) {
    summary_->write(summary_json(result));
    summary_->commit();
  }
  if (picture_) {
    picture_->write(picture_of(experiment, result));
    picture_->commit();
  }
  if (trajectory_) trajectory_->write(result);
  if (recording_) recording_->finish(result);
  if (digests_) digests_->finish();
  if (events_) events_->finish();
}

void Outputs::complete_after_death(const char* reason) {
  sync::write_call_stack(reason);
  of_this_run->cut_off(reason);
}

// In the forked copy. A file that cannot be completed must not cost the others theirs.
void Outputs::cut_off(const std::string& reason) {
  int kept = 0, lost = 0;
  const auto attempt = [&](auto&& complete) {
    try {
      complete();
      ++kept;
    } catch (const std::exception& failure) {
      ++lost;
      dprintf(STDERR_FILENO, "waitpoint: %s\n", failure.what());
    }
  };
  bridge::RunResult result = experiment_->result();
  result.outcome = bridge::Outcome::crashed;
  result.trouble = reason;
  result.seed = seed_;
  result.simulated = experiment_->simulation().global_time().since_start();
  if (summary_)
    attempt([&] {
      summary_->write(summary_json(result));
      summary_->commit();
    });
  if (picture_)
    attempt([&] {
      picture_->write(picture_of(*experiment_, result) + "<!-- cut off: " + reason + " -->\n");
      picture_->commit();
    });
  if (trajectory_) attempt([&] { trajectory_->write(result); });
  if (recording_) attempt([&] { recording_->finish(result); });
  if (digests_) attempt([&] { digests_->cut_off(reason); });
  if (events_) attempt([&] { events_->cut_off(reason); });
  if (kept > 0) dprintf(STDERR_FILENO, "  the outputs up to here are kept, marked as cut off\n");
  if (lost > 0) dprintf(STDERR_FILENO, "  %d of the outputs are lost\n", lost);
}

}  // namespace waitpoint::tools
