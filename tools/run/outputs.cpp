// SPDX-License-Identifier: BSD-3-Clause
#include "tools/run/outputs.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "fibers/kernel/fault_reports.hpp"
#include "tools/output/json_document.hpp"
#include "tools/output/picture.hpp"
#include "tools/output/summary.hpp"
#include "tools/record/formats.hpp"
#include "tools/run/run_json.hpp"
#include "tools/run/viewed_run.hpp"

namespace waitpoint::tools {
namespace {

Outputs* of_this_run = nullptr;

std::string picture_of(const run::Experiment& experiment, const bridge::RunResult& result,
                       const nodes::ShownTopics* shown) {
  const std::vector<nodes::ShownMessage> none;
  return picture_svg(view::obstacles_shown(experiment), result, shown != nullptr ? shown->to_draw() : none);
}

}  // namespace

Outputs::Outputs(const RunOptions& options, const scenario::Scenario& scenario, run::Experiment& experiment)
    : scenario_(scenario),
      experiment_(experiment),
      seed_(options.seed),
      replay_(replay_line(options, options.seed)),
      json_(options.json),
      process_(getpid()) {
  std::vector<std::string> names;
  for (const scenario::RobotScenario& robot : scenario.robots) names.push_back(robot.name);
  check_files(options, names);
  durations_.emplace(options, scenario, experiment);
  if (options.journal) journal_.emplace(*options.journal);
  if (options.summary) summary_.emplace(*options.summary);
  if (options.picture) picture_.emplace(*options.picture);
  if (options.page) page_.emplace(*options.page);
  scene_ = scene_options(options, scenario);
  if (options.digests) digests_.emplace(*options.digests);
  if (options.events) events_.emplace(*options.events);
  if (options.decisions) decisions_.emplace(*options.decisions);
  if (options.record) recording_ = make_recording(*options.record, scenario);
  if (options.trajectory) trajectory_.emplace(*options.trajectory, names);
}

Outputs::~Outputs() {
  try {
    if (is_running_ && journal_) journal_->cut_off("the run failed");
  } catch (const BadInput&) {  // the run's failure is reported
  }
  if (of_this_run != this) return;
  of_this_run = nullptr;
  kernel::set_post_mortem(nullptr);
}

void Outputs::watch() {
  is_running_ = true;
  of_this_run = this;
  kernel::set_post_mortem(complete_after_death);
  if (experiment_.ranks() > 1) return watch_ranks();
  if (events_) events_->watch(experiment_.simulation());
  if (decisions_) decisions_->watch(experiment_.robots());
  for (std::size_t i = 0; i < experiment_.robots().size(); ++i) {
    if (picture_) experiment_.robots()[i]->keep_paths();
    if (trajectory_) experiment_.robots()[i]->add_path_sink(trajectory_->sink(i));
  }
  if (recording_ || page_) watch_steps();
}

void Outputs::watch_steps() {
  if (recording_)
    reader_.emplace(scenario_, experiment_,
                    recording_->shows_obstacles() ? NewsReader::Obstacles::read : NewsReader::Obstacles::left_out);
  if (page_) page_->begin(scenario_, experiment_, scene_);
  // A library that writes bags knows nothing of forked copies.
  experiment_.set_observer([this, other = experiment_.observer()](Time now) {
    if (other) other(now);
    if (getpid() != process_) return;
    if (recording_) record_step(now);
    if (page_) page_->step(now);
  });
}

void Outputs::show(const std::shared_ptr<nodes::ShownTopics>& topics) {
  shown_ = topics;
  if (shown_ && recording_) shown_->begin_recording();
}

void Outputs::record_step(Time now) {
  StepNews news = reader_->take(now);
  if (shown_) news.shown = shown_->take();
  recording_->add(std::move(news));
}

void Outputs::watch_ranks() {
  RankOutputOptions options{.events = events_.has_value(),
                            .paths = trajectory_.has_value(),
                            .picture = picture_.has_value(),
                            .record = recording_ != nullptr};
  options.write_event = [this](const std::string& line) { events_->add(line); };
  options.write_sample = [this](std::size_t robot, bridge::PathKind kind, const bridge::DatedPose& sample) {
    trajectory_->sink(robot).add(kind, sample);
  };
  options.recording = recording_.get();
  ranks_.emplace(scenario_, experiment_, std::move(options));
}

void Outputs::second(std::int64_t second) {
  if (!digests_) return;
  experiment_.gather_records();
  digests_->record(experiment_.simulation(), second);
}

// Each file is completed by a call of `attempt`, if it is requested. An empty `cut_off`: the run ended.
template <class Attempt>
void Outputs::complete(const bridge::RunResult& result, const std::string& cut_off, Attempt attempt) {
  const bool is_cut = !cut_off.empty();
  attempt(journal_, [&](JournalFile& file) { is_cut ? file.cut_off(cut_off) : file.commit(); });
  if (durations_->are_written())
    attempt(durations_, [&](DurationFiles& file) { is_cut ? file.cut_off(cut_off) : file.finish(); });
  attempt(summary_, [&](OutputFile& file) {
    file.write(summary_json(result));
    file.commit();
  });
  attempt(picture_, [&](OutputFile& file) {
    file.write(picture_of(experiment_, result, shown_.get()));
    if (is_cut) file.write("<!-- cut off: " + cut_off + " -->\n");
    file.commit();
  });
  attempt(page_, [&](view::RecordedPage& file) { file.finish(result); });
  attempt(trajectory_, [&](TrajectoryFiles& files) { is_cut ? files.cut_off(cut_off) : files.finish(); });
  attempt(recording_, [&](Recording& file) {
    if (reader_) file.hold(reader_->lines());
    file.finish(result);
  });
  attempt(digests_, [&](DigestRecorder& file) { is_cut ? file.cut_off(cut_off) : file.finish(); });
  attempt(events_, [&](EventRecorder& file) { is_cut ? file.cut_off(cut_off) : file.finish(); });
  attempt(decisions_, [&](DecisionRecorder& file) { is_cut ? file.cut_off(cut_off) : file.finish(); });
}

void Outputs::write(const bridge::RunResult& result) {
  is_running_ = false;
  complete(result, "", [](auto& file, auto finish) {
    if (file) finish(*file);
  });
}

void Outputs::complete_after_death(const char* reason) { of_this_run->cut_off(reason, std::nullopt); }

void Outputs::end_json(const bridge::RunResult& result, std::optional<int> status) const {
  if (!json_) return;
  try {
    OutputFile output("-");
    output.write(json_document("run", status, run_json(result, {}, replay_)));
    output.commit();
  } catch (const std::exception& failure) {
    dprintf(STDERR_FILENO, "waitpoint: %s\n", failure.what());
  }
}

// In the forked copy of a process that dies, or after an exception. A file that cannot be completed must not cost the
// others theirs; its destructor removes its unfinished file.
void Outputs::cut_off(const std::string& reason, std::optional<int> status) {
  is_running_ = false;
  if (getpid() != process_ && getppid() != process_) return;  // a task's child is dying, not the run
  OutputFile::take_over();
  bridge::RunResult result = experiment_.result();
  result.outcome = bridge::Outcome::crashed;
  result.trouble = reason;
  result.seed = seed_;
  result.simulated = experiment_.simulation().global_time().since_start();
  end_json(result, status);
  int kept = 0, lost = 0;
  complete(result, reason, [&](auto& file, auto finish) {
    if (!file) return;
    try {
      finish(*file);
      ++kept;
    } catch (const std::exception& failure) {
      ++lost;
      dprintf(STDERR_FILENO, "waitpoint: %s\n", failure.what());
      file.reset();
    }
  });
  if (kept > 0) dprintf(STDERR_FILENO, "  the outputs up to here are kept, marked as cut off\n");
  if (lost > 0) dprintf(STDERR_FILENO, "  %d of the outputs are lost\n", lost);
}

}  // namespace waitpoint::tools
