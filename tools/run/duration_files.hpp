// SPDX-License-Identifier: BSD-3-Clause
// --record-durations and --replay-durations: what local clocks measured, counted or chose, as a file of a run.
#pragma once

#include <optional>
#include <string>

#include "fibers/sync/duration_record.hpp"
#include "modules/run/experiment.hpp"
#include "tools/output/output_file.hpp"
#include "tools/run/run_options.hpp"

namespace waitpoint::tools {

class DurationFiles {
 public:
  /// Opens what the options name, for the run of `experiment`, which has not begun and outlives this. BadInput for a
  /// file that cannot be written or read, is no record, or is one of another scenario, seed or order.
  DurationFiles(const RunOptions& options, const bridge::Scenario& scenario, bridge::Experiment& experiment);

  /// The run is over: writes the record. BadInput if a run that `ended` by itself did not use up the one it replayed.
  void finish(bool ended);

 private:
  std::optional<OutputFile> file_;
  std::optional<DurationRecorder> recorder_;
  DurationRecord record_;
  std::optional<DurationReplay> replay_;
};

}  // namespace waitpoint::tools
