// SPDX-License-Identifier: BSD-3-Clause
// The frame's robot in virtual time: for tests of timing.
#pragma once

#include "fibers/sync/simulation.hpp"
#include "tests/modules/genom/frame_robot.hpp"

namespace waitpoint::genom {

/// The robot of one test, in a run of its own.
class TestRobot : public FrameRobot {
 public:
  using FrameRobot::FrameRobot;

  /// Runs `drive` as the robot's only task that is not a service, beside the module's.
  waitpoint::Report run(const std::function<void()>& drive, SimulationOptions options = {}) {
    waitpoint::Report report = simulate(
        [&] {
          module.connect();
          module.start();
          drive();
        },
        std::move(options));
    EXPECT_TRUE(report.passed) << report;
    return report;
  }
};

inline Time at(Duration d) { return Time() + d; }

}  // namespace waitpoint::genom
