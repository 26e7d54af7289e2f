// SPDX-License-Identifier: BSD-3-Clause
// Programs of robots: shared objects with a main(), built from unmodified sources, whose threads are tasks of the
// robot. They need the layer in front of the C library, which is present in processes that can load programs
// (fibers/posix/guests/guests.hpp).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "fibers/io/network.hpp"
#include "fibers/posix/guests/guests.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

/// True if any robot has a program.
bool has_programs(const scenario::Scenario& scenario);
/// True if this process can load programs.
bool can_load_programs();

/// The programs of a run.
class RobotPrograms {
 public:
  explicit RobotPrograms(kernel::Scheduler& scheduler) : scheduler_(scheduler) {}
  /// The network that carries data between programs of different robots; without it, data arrive at once. Valid until
  /// take_away().
  void set_network(io::Network& network);
  ~RobotPrograms() { take_away(); }
  RobotPrograms(const RobotPrograms&) = delete;
  RobotPrograms& operator=(const RobotPrograms&) = delete;

  /// Loads a program, which begins at the start of the run. A file that cannot be loaded is BadInput.
  void add(const scenario::ProgramScenario& program, kernel::Robot& robot);
  /// Abandons the programs where they are. Call before the run is unwound.
  void take_away();
  /// Exit statuses of the robot's programs, in the order of add(); none for a program that has not ended.
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
