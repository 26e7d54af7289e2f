// SPDX-License-Identifier: BSD-3-Clause
// A program of a robot: a shared object with a main(), from sources that know nothing of waitpoint, whose threads are
// tasks of the robot. What makes them so is a library in front of the C library, which the process has where programs
// can be loaded (fibers/posix/guests/guests.hpp).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fibers/io/network.hpp"
#include "fibers/posix/guests/guests.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

/// Whether any robot has one.
bool has_programs(const scenario::Scenario& scenario);
/// Whether this process can load them.
bool can_load_programs();

/// The programs of a run.
class RobotPrograms {
 public:
  explicit RobotPrograms(kernel::Scheduler& scheduler) : scheduler_(scheduler) {}
  /// By which what programs of different robots send to each other arrives, in place of at once. It stays until they
  /// are taken away.
  void set_network(io::Network& network);
  ~RobotPrograms() { take_away(); }
  RobotPrograms(const RobotPrograms&) = delete;
  RobotPrograms& operator=(const RobotPrograms&) = delete;

  /// Loads one that begins at the start of the run. BadInput where it cannot be.
  void add(const scenario::ProgramScenario& program, kernel::Robot& robot);
  /// To be called before the run is unwound: they end where they are.
  void take_away();
  /// The exit statuses of the robot's, in the order in which they were added; none of those that have not ended.
  std::vector<std::optional<int>> exit_statuses(const kernel::Robot& robot) const;

 private:
  struct Loaded {
    posix::Guest* guest;
    const kernel::Robot* robot;
  };

  kernel::Scheduler& scheduler_;
  std::vector<Loaded> programs_;
  posix::Carrier carrier_{};
};

}  // namespace waitpoint::run
