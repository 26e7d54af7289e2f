// SPDX-License-Identifier: BSD-3-Clause
// The operator of a run: executes interventions at steps of the world.
//
// Interventions for step k are executed in the world's task just before that step, in the order of their submission,
// and are part of the environment's digest. They make no earlier event: an intervention known long before its time
// (from a journal) and one typed a moment ago (at a prompt) give the same run. A request is sent by a task of the
// robot, a service called "operator", which starts at that instant and waits for the final reply; of a robot that is
// elsewhere it is sent there. Notices of external robots appear among the results.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/io/network.hpp"
#include "fibers/kernel/task.hpp"
#include "modules/bridge/robot.hpp"
#include "modules/run/intervention.hpp"
#include "modules/tcl/shell.hpp"
#include "world/world.hpp"

namespace waitpoint::run {

/// Bound on the interventions of one run, without reports and commands from outside.
inline constexpr std::size_t interventions_max = 100'000;

/// The result of an intervention, or a reply to a request.
struct InterventionOutcome {
  Time date;
  std::string text;             ///< "move rackham 1 2: done"
  bool is_reply = false;        ///< by a module, to a request
  std::string of = "operator";  ///< or an external robot
};

class Operator {
 public:
  /// All arguments must outlive the operator; lanes in the order of the robots.
  Operator(world::World& world, io::Network& network, const std::vector<std::unique_ptr<bridge::Robot>>& robots,
           const std::vector<kernel::Robot*>& lanes)
      : world_(world), network_(network), robots_(robots), lanes_(lanes) {}

  /// Schedules an intervention for a step of the world, which is returned: the next one, or the first at or after
  /// `date`. An unknown robot, obstacle, module, request or field, a date in the past, or exceeding interventions_max,
  /// is BadInput.
  Time add(Intervention intervention, std::optional<Time> date);

  /// Executes the scheduled interventions; called in the world's task before the step at `now`.
  void act(Time now);

  /// So far, in the order of their dates.
  const std::vector<InterventionOutcome>& outcomes() const { return outcomes_; }
  /// The figures of an external robot; nothing for others.
  std::optional<bridge::ExternalFigures> external_figures(std::size_t robot) const;
  /// A reply that came elsewhere.
  void add_reply(const InterventionOutcome& reply) { outcomes_.push_back(reply); }

 private:
  struct Planned {
    Time date;
    Intervention intervention;
  };

  Time step_for(const Intervention& intervention, std::optional<Time> date) const;
  void check(const Intervention& intervention);
  void check(const ModuleRequest& request, const scenario::Location& written) const;
  void check(const ShellCommand& command, const scenario::Location& written) const;
  void check(const ExternalDeclaration& external, const scenario::Location& written);
  void check(const ExternalReport& report, const scenario::Location& written) const;
  std::string carry_out(const Intervention& intervention);
  std::string carry_out(const ModuleRequest& request, const Intervention& whole);
  std::string carry_out(const RobotMove& move, const Intervention& whole);
  std::string carry_out(const ObstacleMove& move, const Intervention& whole);
  std::string carry_out(const ObstaclePut& put, const Intervention& whole);
  std::string carry_out(const ObstacleRemoval& removal, const Intervention& whole);
  std::string carry_out(const Push& push, const Intervention& whole);
  std::string carry_out(const SeedChange& change, const Intervention& whole);
  std::string carry_out(const ShellCommand& command, const Intervention& whole);
  std::string carry_out(const ExternalDeclaration& external, const Intervention& whole);
  std::string carry_out(const ExternalReport& report, const Intervention& whole);
  std::string carry_out(const DriveCommand& command, const Intervention& whole);
  std::string carry_out(const PublishedPose& published, const Intervention& whole);
  std::string carry_out(const GoalEnd& end, const Intervention& whole);

  world::World& world_;
  io::Network& network_;
  const std::vector<std::unique_ptr<bridge::Robot>>& robots_;
  const std::vector<kernel::Robot*>& lanes_;
  std::deque<Planned> planned_;  // by date
  std::size_t added_ = 0;
  std::vector<InterventionOutcome> outcomes_;
  std::map<std::size_t, std::unique_ptr<tcl::Shell>> shells_;       // by robot, since their first commands
  std::set<std::size_t> external_declared_;                         // by robot, from their declarations on
  std::map<std::size_t, std::unique_ptr<ExternalRobot>> external_;  // since the execution of these
  Time now_;                                                        // of act()
};

}  // namespace waitpoint::run
