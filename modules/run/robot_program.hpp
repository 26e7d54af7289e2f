// SPDX-License-Identifier: BSD-3-Clause
// Programs of robots, from unmodified sources, in the run's virtual time: see core/hosting/program_host.hpp.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/hosting/hosted_programs.hpp"
#include "fibers/io/network.hpp"
#include "fibers/posix/links/carrier.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::run {

/// True if any robot has a program that is hosted so.
bool has_programs(const scenario::Scenario& scenario, Hosting hosting);
/// The environment variable with the path of the library that is preloaded into programs that are processes. Beside it
/// is the program that executes a shared object.
inline constexpr char library_variable[] = "WAITPOINT_COMMAND_LIBRARY";
inline constexpr char loader_file[] = "waitpoint-load";

/// The programs of a run.
class RobotPrograms {
 public:
  explicit RobotPrograms(kernel::Scheduler& scheduler) : scheduler_(scheduler) {}
  /// The network that carries data between programs of different robots, if these are in-process; without it, data
  /// arrive at once. Called first. Valid until take_away().
  void set_network(io::Network& network);
  ~RobotPrograms() { take_away(); }
  RobotPrograms(const RobotPrograms&) = delete;
  RobotPrograms& operator=(const RobotPrograms&) = delete;

  /// Adds a program, which begins when its conditions hold. What cannot be loaded or started is BadInput.
  void add(const scenario::ProgramScenario& program, const kernel::Robot& robot);
  /// Abandons the programs where they are. Call before the run is unwound.
  void take_away();
  /// Exit statuses of the robot's programs, in the order of add(); none for a program that has not ended.
  std::vector<std::optional<int>> exit_statuses(const kernel::Robot& robot) const;

 private:
  struct Look {
    kernel::EventNode node;  // first: its address is the event's
    RobotPrograms* programs = nullptr;
  };
  static void look(kernel::EventNode& node);
  void make_host(const scenario::ProgramScenario& first);
  void start_if_due(std::size_t program);
  void start_those_due();

  kernel::Scheduler& scheduler_;
  std::unique_ptr<ProgramHost> host_;  // made with the first program
  std::optional<HostedPrograms> programs_;
  std::vector<scenario::ProgramScenario> scenarios_;  // of the programs
  Look look_;  // for conditions of starts, each millisecond while a program waits
  posix::Carrier carrier_{};
};

}  // namespace waitpoint::run
