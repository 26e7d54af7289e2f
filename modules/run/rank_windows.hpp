// SPDX-License-Identifier: BSD-3-Clause
// The windows of virtual time of one rank: it runs its own robots, then all ranks exchange the crossing messages.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/io/network.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/bridge/robot.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/run/operator.hpp"
#include "modules/run/rank_window.hpp"
#include "modules/run/ranks/ranks.hpp"
#include "modules/run/ranks/remote_step.hpp"
#include "modules/run/world_steps.hpp"

namespace waitpoint::run {

/// The parts of an experiment; all must outlive the windows.
struct RankedParts {
  Simulation& simulation;
  world::World& world;
  const std::vector<std::unique_ptr<bridge::Robot>>& robots;
  const std::vector<kernel::Robot*>& lanes;  // by robot
  Operator& the_operator;
  io::Network& network;
  WorldSteps steps;
};

/// Thrown on all ranks after the same window, whose exchange took place: an exception in a task of any, or replicated
/// state that differs.
struct FailedTogether : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class RankWindows {
 public:
  /// Robots elsewhere have their lanes already.
  RankWindows(Ranks& ranks, const RankedParts& parts);
  RankWindows(const RankWindows&) = delete;
  RankWindows& operator=(const RankWindows&) = delete;

  /// Collective: executes all events before `until`. Throws FailedTogether.
  RunEnd run_before(Time until);

  /// On the world's task: releases the bridge of a robot elsewhere.
  void step(std::size_t robot) { remote_steps_[robot].release(); }
  /// The processor time that the world's step took.
  void add_world_time(double seconds) { figures_.world_s += seconds; }

  /// Of the last task but services of all ranks.
  std::optional<Time> last_end() const { return last_end_; }
  /// See Simulation::trouble().
  const std::string& trouble() const { return trouble_; }
  const bridge::RankFigures& figures() const { return figures_; }

 private:
  void send_elsewhere();
  Time end_of_window() const;
  Window run_window(Time end);
  Failure failure_in(Time end);
  void note_steps(Window& window) const;
  RunEnd take_over(const std::vector<Window>& windows, Time end);
  void check_replicas(const std::vector<Window>& windows, Time end);
  bool is_here(std::size_t robot) const { return ranks_.placement().is_here(robot); }

  Ranks& ranks_;
  RankedParts parts_;
  std::vector<bridge::BodyCommand> commands_;  // of robots here, in this window
  std::vector<Message> messages_;              // to robots elsewhere, in this window
  std::vector<RemoteStep> remote_steps_;       // by robot; unused for those here
  std::vector<GoalCounts> reported_;           // by robot
  std::vector<std::uint64_t> bodies_;          // hashes of their states at the end of this window, by robot
  std::size_t seen_outcomes_ = 0;
  Time reached_;
  std::uint64_t windows_ = 0;
  std::optional<Time> last_end_here_, last_end_;  // of a task but services, on this rank; of the last one of all
  std::string trouble_;
  bridge::RankFigures figures_;
};

}  // namespace waitpoint::run
