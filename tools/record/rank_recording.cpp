// SPDX-License-Identifier: BSD-3-Clause
#include "tools/record/rank_recording.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "modules/run/ranks/archive.hpp"

namespace waitpoint::tools {

RankRecording::RankRecording(const scenario::Scenario& scenario, run::Experiment& experiment, Recording* recording)
    : reader_(scenario, experiment,
              recording != nullptr && recording->shows_obstacles() ? NewsReader::Obstacles::read
                                                                   : NewsReader::Obstacles::left_out),
      recording_(recording) {
  experiment.set_observer([this](Time now) { steps_.push_back(reader_.take(now)); });
}

// What the first rank has stays there, with the obstacles.
std::string RankRecording::load() {
  if (recording_ != nullptr) return "";
  Load load;
  for (StepNews& step : std::exchange(steps_, {})) load.steps.push_back(std::move(step.robots));
  load.lines = reader_.lines();
  run::Packing packing;
  packing(load);
  return std::move(packing.bytes());
}

void RankRecording::unload(std::span<const std::string> loads) {
  std::vector<RobotLines> lines = reader_.lines();
  for (const std::string& bytes : loads.subspan(1)) {
    Load load;
    run::Unpacking unpacking(bytes);
    unpacking(load);
    WAITPOINT_CHECK(load.steps.size() == steps_.size(), "ranks have recorded different steps");
    for (std::size_t i = 0; i < steps_.size(); ++i)
      std::ranges::move(load.steps[i], std::back_inserter(steps_[i].robots));
    std::ranges::move(load.lines, std::back_inserter(lines));
  }
  for (StepNews& step : std::exchange(steps_, {})) {
    std::ranges::sort(step.robots, {}, &RobotNews::robot);
    recording_->add(std::move(step));
  }
  recording_->hold(lines);
}

}  // namespace waitpoint::tools
