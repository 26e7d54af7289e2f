// SPDX-License-Identifier: BSD-3-Clause
// A page of a finished run: one file of HTML with all that the viewer's page shows, which opens offline.
//
// It is made of readings after steps of the world, ten times a simulated second for a robot, less often for crowds
// and long runs, and of the run's first events, two million at most. A run is the same with and without it.
#pragma once

#include <deque>
#include <filesystem>
#include <optional>
#include <string>

#include "modules/bridge/run_result.hpp"
#include "modules/run/experiment.hpp"
#include "tools/output/output_file.hpp"
#include "tools/record/module_log.hpp"
#include "tools/view/compressed_text.hpp"
#include "tools/view/event_counts.hpp"
#include "tools/view/event_trace.hpp"
#include "tools/view/frame_reader.hpp"
#include "tools/view/poster_plots.hpp"
#include "tools/view/scene.hpp"

namespace waitpoint::tools::view {

class RecordedPage {
 public:
  /// Throws BadInput if the file cannot be written.
  explicit RecordedPage(const std::filesystem::path& path) : file_(path) {}

  /// Before the run; the arguments must outlive it.
  void begin(const scenario::Scenario& scenario, run::Experiment& experiment, const SceneOptions& options);
  /// After each step of the world.
  void step(Time now);
  /// Writes the file. Throws BadInput if it could not be written.
  void finish(const bridge::RunResult& result);

 private:
  void take_frame(Time now);

  OutputFile file_;
  run::Experiment* experiment_ = nullptr;
  CompressedText text_;
  std::deque<ModuleLog> logs_;  // by robot
  std::optional<FrameReader> frames_;
  std::optional<PosterPlots> plots_;
  std::optional<EventCounts> counts_;
  std::optional<EventTrace> events_;
  Duration period_, scan_period_;
  Time next_, next_scan_;
  bool has_frame_ = false;
};

}  // namespace waitpoint::tools::view
