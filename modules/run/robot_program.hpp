// SPDX-License-Identifier: BSD-3-Clause
// Programs of robots, from unmodified sources: shared objects with a main(), whose threads are tasks of the robot, and
// commands, which are processes of one family in the run's virtual time (fibers/posix/host/hosted_family.hpp). Shared
// objects need the layer in front of the C library, which is present in processes that can load them
// (fibers/posix/guests/guests.hpp).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fibers/io/network.hpp"
#include "fibers/posix/guests/guests.hpp"
#include "fibers/posix/host/hosted_family.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

/// True if any robot has a program of that kind.
bool has_shared_objects(const scenario::Scenario& scenario);
bool has_commands(const scenario::Scenario& scenario);
/// The environment variable with the path of the library that is preloaded into commands.
inline constexpr char library_variable[] = "WAITPOINT_COMMAND_LIBRARY";
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

  /// Loads or starts a program, which begins at the start of the run. What cannot be loaded or started is BadInput.
  void add(const scenario::ProgramScenario& program, kernel::Robot& robot);
  /// Abandons the programs where they are. Call before the run is unwound.
  void take_away();
  /// Exit statuses of the robot's programs, in the order of add(); none for a program that has not ended.
  std::vector<std::optional<int>> exit_statuses(const kernel::Robot& robot) const;

 private:
  struct Loaded {
    scenario::ProgramScenario program;
    kernel::Robot* robot;
    posix::Guest* guest = nullptr;  // of a shared object
    int number = -1;                // of a command
    bool has_started = false;
  };
  struct Look {
    kernel::EventNode node;  // first: its address is the event's
    RobotPrograms* programs = nullptr;
  };
  static void look(kernel::EventNode& node);
  void load(Loaded& loaded);
  void start(Loaded& loaded);
  void start_those_due();
  bool holds(const StartCondition& condition, const kernel::Robot& robot) const;
  std::optional<int> exit_status(const Loaded& program) const;

  kernel::Scheduler& scheduler_;
  std::vector<Loaded> programs_;
  std::unique_ptr<posix::HostedFamily> commands_;
  Look look_;  // for conditions of starts, each millisecond while a program waits
  posix::Carrier carrier_{};
};

}  // namespace waitpoint::run
