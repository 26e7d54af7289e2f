// SPDX-License-Identifier: BSD-3-Clause
// A run that is viewed, in its own process: it sends frames and its status to the viewer's process, makes snapshots of
// itself, and, if it is controlled, is paused and paced from there. Nothing of this is an event.
//
// To the viewer: the scene (scene.hpp), frames when they are wanted, its status, lines of the modules' log, snapshots.
// From the viewer: {"do":"frame",...} once for each frame, "pause" {on}, "speed" {value}.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "modules/bridge/run_result.hpp"
#include "modules/run/experiment.hpp"
#include "tools/record/module_log.hpp"
#include "tools/view/event_counts.hpp"
#include "tools/view/frame_reader.hpp"
#include "tools/view/history/channel.hpp"
#include "tools/view/history/memory_use.hpp"
#include "tools/view/scene.hpp"

namespace waitpoint::tools::view {

class LiveRun {
 public:
  /// Before the run, which must outlive this, as the scenario. `journal`: its head, and its interventions if it repeats
  /// some.
  LiveRun(Channel& viewer, const scenario::Scenario& scenario, run::Experiment& experiment, const SceneOptions& options,
          std::string journal);

  /// A line of the run's journal.
  void add_to_journal(const std::string& line) { journal_ += line; }

  /// After each window of the run: everything before `reached` is done. Waits while the run is paused, until `is_over`
  /// returns true.
  void after_window(Time reached, const std::function<bool()>& is_over);
  /// The speed that was asked for since the last call, if any; 0: as fast as it computes.
  std::optional<double> take_speed() { return std::exchange(speed_, std::nullopt); }

  /// The run is over.
  void finish(const bridge::RunResult& result);

 private:
  void take_requests();
  void heed(const std::string& text);
  void make_snapshot();
  void send_frame();
  void send_status();
  void send_log();

  Channel& viewer_;
  run::Experiment& experiment_;
  std::string journal_;
  FrameReader frames_;
  EventCounts counts_;
  std::deque<ModuleLog> logs_;  // by robot
  Time reached_;
  std::optional<FrameOptions> wanted_;  // a frame
  std::optional<double> speed_;
  bool is_paused_ = false;
  double next_snapshot_s_ = 0, snapshot_period_s_, next_status_s_ = 0;  // processor time; wall clock
  double copying_period_s_ = 0;  // the least, for copies of pages; 0: not known yet
  MemoryUse at_snapshot_;        // when the last one was made
};

}  // namespace waitpoint::tools::view
