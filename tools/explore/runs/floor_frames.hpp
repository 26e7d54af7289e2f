// SPDX-License-Identifier: BSD-3-Clause
// The floor during a run of a scenario, for the page of a finding: where the robots are, what they see.
#pragma once

#include <string>
#include <utility>

#include "tools/view/frame_reader.hpp"

namespace waitpoint::tools {

class FloorFrames {
 public:
  /// Frames from that time on, the first of them now if that is later. The arguments must outlive this.
  FloorFrames(const scenario::Scenario& scenario, const run::Experiment& experiment, Time from, Time now)
      : reader_(scenario, experiment), from_(from) {
    step(now);
  }

  /// Between events of the run, several times a second.
  void step(Time now) {
    if (now < from_) return;
    // Scans are the greater part of a frame.
    constexpr std::uint32_t frames_per_scan = 5;
    if (count_ > 0) frames_ += ",";
    frames_ += reader_.read(now, {.scans = count_ % frames_per_scan == 0}) + "}";
    ++count_;
  }

  /// {...},{...}
  std::string take() { return std::move(frames_); }

 private:
  view::FrameReader reader_;
  Time from_;
  std::string frames_;
  std::uint32_t count_ = 0;
};

}  // namespace waitpoint::tools
