// SPDX-License-Identifier: BSD-3-Clause
// The recording of a run of several ranks: each reads the news of its robots, the first one also the obstacles, and
// writes them in the order of one process.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "modules/run/ranks/freight.hpp"
#include "tools/record/news_reader.hpp"
#include "tools/record/recording.hpp"

namespace waitpoint::tools {

class RankRecording final : public run::Freight {
 public:
  /// On each rank, as NewsReader. `recording`, which must outlive this, is where the news go on the first rank; null
  /// elsewhere.
  RankRecording(const scenario::Scenario& scenario, run::Experiment& experiment, Recording* recording);

  std::string load() override;
  void unload(std::span<const std::string> loads) override;

 private:
  /// Of one rank.
  struct Load {
    std::vector<std::vector<RobotNews>> steps;
    std::vector<RobotLines> lines;  // since the last of them
    friend void carry(auto& archive, Load& load) { archive(load.steps, load.lines); }
  };

  NewsReader reader_;
  Recording* recording_;
  std::vector<StepNews> steps_;  // since the last shipment
};

}  // namespace waitpoint::tools
