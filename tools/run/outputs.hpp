// SPDX-License-Identifier: BSD-3-Clause
// The output files of one run: opened before it starts, written when it is over.
//
// If the process dies in a task, a forked copy of it completes them (kernel/fault_reports.hpp): they have their names,
// what was known by then, and a mark that they are cut off: the outcome "crashed" in the summary, a last comment or log
// message in the others.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "modules/run/experiment.hpp"
#include "tools/output/output_file.hpp"
#include "tools/output/recorders.hpp"
#include "tools/output/trajectory.hpp"
#include "tools/record/recording.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

class Outputs {
 public:
  /// Throws BadInput if a file cannot be written. Both must outlive the outputs.
  Outputs(const RunOptions& options, const scenario::Scenario& scenario);
  ~Outputs();
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  /// Before the run; the experiment must outlive the outputs' last use.
  void watch(run::Experiment& experiment);
  void second(const Simulation& simulation, std::int64_t second) {
    if (digests_) digests_->record(simulation, second);
  }
  /// Writes and names all files. Throws BadInput if one cannot be written; the others are as before.
  void write(run::Experiment& experiment, const bridge::RunResult& result);

 private:
  static void complete_after_death(const char* reason);
  void cut_off(const std::string& reason);

  std::optional<OutputFile> summary_, picture_;
  std::optional<TrajectoryFiles> trajectory_;
  std::optional<DigestRecorder> digests_;
  std::optional<EventRecorder> events_;
  std::unique_ptr<Recording> recording_;
  run::Experiment* experiment_ = nullptr;
  std::uint64_t seed_;
};

}  // namespace waitpoint::tools
