// SPDX-License-Identifier: BSD-3-Clause
// An executive that is a script in Tcl. Beside the commands of a client of modules it has those of its mission:
//
//   waitpoint::goals                 the robot's goals: {{x 2.4 y 4.6} ...}
//   waitpoint::reached I             the goal with this number, from 0, has been reached
//   waitpoint::missed I              it is given up
//   waitpoint::start                 the robot's known pose: {x 20 y 4 heading 1.57}
//   waitpoint::position              by pom.position
//   waitpoint::plan X Y              a route on the known map from the present position, as points; fails if there is
//   none waitpoint::look, ::mark          keeps the present echoes; marks the kept ones on the map waitpoint::forget
//   deletes the marks waitpoint::compute US            the cost of the script's code before it
//
// An error of the script ends the run, like one of a module's code.
//
// Below a temporal plan the script defines procedures; at its end the task evaluates the calls of the module
// Procedures, until stop(). An error of a procedure is the failure of its call. An interrupted procedure ends where it
// waits, and the requests that it has sent are aborted.
#pragma once

#include <atomic>
#include <deque>
#include <map>

#include "modules/executive/executive_setup.hpp"
#include "modules/executive/looks.hpp"
#include "modules/executive/robot_executive.hpp"
#include "modules/tcl/module_link.hpp"
#include "modules/tcl/procedures.hpp"

namespace waitpoint::tcl {

class TclExecutive : public executive::RobotExecutive, private ModuleLink {
 public:
  /// The calls of the robot's module Procedures, if it has one, are evaluated after the script.
  explicit TclExecutive(const executive::ExecutiveSetup& setup);
  static bool takes(const executive::ExecutiveSetup& setup) { return setup.script.has_value(); }

  void connect() override;
  void run() override;
  void stop() override;
  /// The script's rand() goes on from the seed that it would have had with this stream.
  void reseed(const RandomStream& random) override;
  const std::vector<executive::GoalRecord>& goals() const override { return goals_; }
  /// The first without a result from the script.
  std::size_t current_goal() const override;

 private:
  /// Thrown by blocking commands after stop().
  struct Stopped {};
  /// Thrown by blocking commands of an interrupted procedure.
  struct Interrupted {};
  /// A request of the script that has not ended.
  struct Running {
    std::string module;
    std::int32_t activity = -1;
    bool is_aborted = false;
  };

  std::vector<std::string> modules() const override;
  Answer send(const std::string& module, const std::string& request, const std::vector<Setting>& input) override;
  std::optional<ReplyText> receive(Duration timeout) override;
  void sleep_until(Time time) override;
  std::vector<std::string> commands() const override;
  Answer carry_out(const std::string& command, const std::vector<std::string>& words) override;
  Answer finish_goal(const std::vector<std::string>& words, executive::GoalState state);
  Answer plan(const std::vector<std::string>& words);
  void serve(Interpreter& interpreter);
  void check_stop() const;
  bool take(Duration timeout);
  void abort_requests();
  void stop_modules();

  executive::ExecutiveSetup setup_;
  const Library& library_;
  executive::RoutePlanner planner_;
  executive::Looks looks_;
  bool can_look_ = false;
  std::vector<executive::GoalRecord> goals_;
  Procedures* procedures_;
  std::map<std::uint32_t, Running> running_;  // by number
  std::deque<ReplyText> replies_;             // received, and not yet the script's
  std::atomic<bool> stopping_ = false;
  Interpreter* interpreter_ = nullptr;  // of run()
};

}  // namespace waitpoint::tcl
