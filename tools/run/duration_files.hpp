// SPDX-License-Identifier: BSD-3-Clause
// --record-durations and --replay-durations: the durations that local clocks measured, counted or drew, as a file.
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
  /// Opens the files that the options name. `experiment` has not begun and outlives this. BadInput for a file that
  /// cannot be written or read, is not a record, or belongs to another scenario, seed or order.
  DurationFiles(const RunOptions& options, const scenario::Scenario& scenario, run::Experiment& experiment);

  /// Throws BadInput if a run that `ended` by itself did not use up the replayed record.
  void check(bool ended) const;
  /// Writes and names the record after the run.
  void finish();
  bool are_written() const { return file_.has_value(); }
  /// The same with a comment as last line: the process dies for `reason`.
  void cut_off(const std::string& reason);

 private:
  std::optional<OutputFile> file_;
  std::optional<DurationRecorder> recorder_;
  DurationRecord record_;
  std::optional<DurationReplay> replay_;
};

}  // namespace waitpoint::tools
