// SPDX-License-Identifier: BSD-3-Clause
// The output files of one run: opened before it starts, written when it is over.
//
// If the process dies in a task, a forked copy of it completes them (kernel/fault_reports.hpp): they have their names,
// the contents up to then, and a mark that they are cut off: the outcome "crashed" in the summary, a last comment or
// log message in the others. The journal is also kept if the run fails by an exception.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "modules/nodes/shown_topics.hpp"
#include "modules/run/experiment.hpp"
#include "tools/output/decision_recorder.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/recorders.hpp"
#include "tools/output/trajectory.hpp"
#include "tools/record/news_reader.hpp"
#include "tools/record/recording.hpp"
#include "tools/run/duration_files.hpp"
#include "tools/run/journal_file.hpp"
#include "tools/run/rank_outputs.hpp"
#include "tools/run/run_options.hpp"
#include "tools/view/recorded_page.hpp"

namespace waitpoint::tools {

class Outputs {
 public:
  /// Throws BadInput if a file cannot be written, or for a record of durations of another run. The experiment has not
  /// begun; it and the scenario outlive the outputs.
  Outputs(const RunOptions& options, const scenario::Scenario& scenario, run::Experiment& experiment);
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  /// The requested journal, or null. write() names it.
  JournalFile* journal() { return journal_ ? &*journal_ : nullptr; }
  /// Shown topics of ROS nodes, for the picture and the recording; null: there are none. Before the run.
  void show(const std::shared_ptr<nodes::ShownTopics>& topics);
  /// Call before the run.
  void watch();
  void second(std::int64_t second);
  /// Throws BadInput if the run is not that of --replay-durations.
  void check(const bridge::RunResult& result) const { durations_->check(result.outcome == bridge::Outcome::finished); }
  /// Writes and names all files. Throws BadInput if one cannot be written; those not yet named are as before.
  void write(const bridge::RunResult& result);
  /// Completes all files with the contents up to here, marked as cut off: the run failed. Nothing is thrown. Without a
  /// status a signal ends the process.
  void cut_off(const std::string& reason, std::optional<int> status);

 private:
  static void complete_after_death(const char* reason);
  template <class Attempt>
  void complete(const bridge::RunResult& result, const std::string& cut_off, Attempt attempt);
  void watch_ranks();
  void watch_steps();
  void record_step(Time now);
  void end_json(const bridge::RunResult& result, std::optional<int> status) const;

  const scenario::Scenario& scenario_;
  run::Experiment& experiment_;
  std::optional<JournalFile> journal_;
  std::optional<DurationFiles> durations_;
  std::optional<OutputFile> summary_, picture_;
  std::optional<view::RecordedPage> page_;
  std::optional<TrajectoryFiles> trajectory_;
  std::optional<DigestRecorder> digests_;
  std::optional<EventRecorder> events_;
  std::optional<DecisionRecorder> decisions_;
  std::unique_ptr<Recording> recording_;
  std::optional<NewsReader> reader_;  // for the recording of one process
  std::shared_ptr<nodes::ShownTopics> shown_;
  std::optional<RankOutputs> ranks_;  // of several
  view::SceneOptions scene_;          // for the page
  std::uint64_t seed_;
  std::string replay_;  // the command
  bool json_;           // wanted
  pid_t process_;       // of the run
  bool is_running_ = false;
};

}  // namespace waitpoint::tools
