// SPDX-License-Identifier: BSD-3-Clause
// A run of several ranks, with the digests of one process. Every rank has the whole world and steps it; the tasks of a
// robot are on one rank.
//
//   window [T_k, T_k+1)      each rank alone: the world's step at T_k, then its own robots
//   exchange at its end      commands to bodies, goals, ends, failures: see rank_window.hpp
//   window [T_k+1, ...)      the world's step takes the commands of all
//
// A command is latched by the world's next step, in one process too, so nothing comes too late; messages between robots
// arrive no earlier than their medium's least latency, which cuts windows where it is below the world's step. The order
// of a robot's events does not depend on other robots' events, so its digest is that of one process.
//
// The first rank leads: it carries out a call of its user, and first tells the others, which carry out the same.
// Replicated state is compared at the end of each window.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "fibers/io/network.hpp"
#include "fibers/sync/simulation.hpp"
#include "modules/bridge/robot.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/run/operator.hpp"
#include "modules/run/rank_windows.hpp"
#include "modules/run/ranks/freight.hpp"
#include "modules/run/ranks/ranks.hpp"
#include "modules/run/ranks/results.hpp"

namespace waitpoint::run {

class RankedRun {
 public:
  /// Collective. Robots elsewhere have their lanes already.
  RankedRun(Ranks& ranks, const RankedParts& parts);
  /// The leader's: the others leave follow().
  ~RankedRun();
  RankedRun(const RankedRun&) = delete;
  RankedRun& operator=(const RankedRun&) = delete;

  RankWindows& windows() { return windows_; }
  const RankWindows& windows() const { return windows_; }

  // The leader's calls.

  /// See RankWindows::run_before().
  RunEnd run_before(Time until);
  Time intervene(const Intervention& intervention, std::optional<Time> date);
  /// Experiment::idle() of all ranks.
  std::string idle(Duration least);
  /// Experiment::tasks() of all ranks.
  std::string tasks();
  /// Takes over the other ranks' records of their robots, for digests and counts of events.
  void gather_records();
  /// Completes a result by the robots that are elsewhere.
  void complete(bridge::RunResult& result);

  /// On the other ranks: follows the leader, up to its end.
  void follow();

  /// Shipped after each run_before(). On all ranks in the same order, before the first one. It must outlive this.
  void add(Freight& freight) { freights_.push_back(&freight); }
  /// The number of events of services elsewhere after the ends of their robots; after gather_records().
  std::uint64_t events_after_ends_elsewhere() const { return after_ends_elsewhere_; }

  /// For the calls above on each rank: the experiment's own.
  std::function<Time(const Intervention&, std::optional<Time>)> add_intervention;
  std::function<std::string(Duration)> describe_idle;
  std::function<std::string(const kernel::Robot&)> list_tasks;
  std::function<bridge::RobotResult(std::size_t robot)> result_of;

 private:
  struct Call;

  void tell(const Call& call);
  void obey(const Call& call);
  RunEnd carry_on(Time until);
  void ship();
  Records records_here() const;
  void take_over(const std::vector<Records>& records);
  Results results_here() const;
  std::vector<RobotTasks> tasks_here() const;
  bool is_here(std::size_t robot) const { return ranks_.placement().is_here(robot); }

  Ranks& ranks_;
  RankedParts parts_;
  RankWindows windows_;
  std::vector<Freight*> freights_;
  std::uint64_t after_ends_elsewhere_ = 0;
  bool is_over_ = false;  // the others do not wait for a call
};

}  // namespace waitpoint::run
