// SPDX-License-Identifier: BSD-3-Clause
// The processes of a launch's nodes: each is started in its order, when its conditions hold, and watched until its end.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/hosting/hosted_programs.hpp"
#include "core/hosting/spawned_processes.hpp"
#include "core/time.hpp"
#include "modules/nodes/master_side.hpp"
#include "modules/ros1/launch.hpp"

namespace waitpoint::nodes {

/// A node, and the words of its process: its executable and arguments.
struct NodeCommand {
  ros1::Node node;
  std::vector<std::string> words;
  std::optional<Duration> time_limit = {};  ///< of a test, which is to end with status 0
};

/// A line for the person at the run.
struct NodeNews {
  std::string node, text;
  bool is_fault = false;
  bool is_failure = false;  ///< a fault: it has ended by a signal or with another status than 0, or did not start
};

/// How nodes end with the run.
enum class NodeEnds : unsigned char { asked, killed };

class NodeProcesses {
 public:
  /// `master` must outlive this.
  NodeProcesses(std::vector<NodeCommand> commands, const MasterSide& master, NodeEnds ends = NodeEnds::asked,
                const std::vector<EnvironmentVariable>& environment = {});
  ~NodeProcesses() { end(); }
  NodeProcesses(const NodeProcesses&) = delete;
  NodeProcesses& operator=(const NodeProcesses&) = delete;

  /// Starts the nodes with conditions that hold, and notes those that have ended. `now` is the run's virtual time.
  void go_on(Time now);
  /// Since the last call.
  std::vector<NodeNews> take_news() { return std::exchange(news_, {}); }
  /// True when a required node has ended, or all tests have.
  bool is_over() const { return is_over_; }
  /// True when all have ended.
  bool have_ended() const { return programs_.have_all_ended(); }
  /// True when those that could start so far have registered with the master, ended, or been told of.
  bool are_there() const;
  /// A line for each node that was never started: its conditions.
  std::vector<std::string> not_started() const;
  bool have_tests() const;
  /// A line for each test that has failed, or has not ended, within its time if `now` is given.
  std::vector<std::string> unmet_tests(std::optional<Time> now) const;
  /// Asks all nodes to end, unless they are to be killed, and kills those that do not within some seconds.
  void end();

 private:
  struct WatchedNode {
    NodeCommand command;
    Time started = {};
    bool is_registered = false, is_missed = false;
    bool is_end_noted = false;

    std::string name() const { return command.node.global_name(); }
    bool is_test() const { return command.time_limit.has_value(); }
  };

  bool is_advertised(const StartCondition& condition) const;
  void start_if_due(std::size_t number, Time now);
  void watch(std::size_t number, Time now);
  void note_ends();
  void note_end(WatchedNode& node, const ProgramEnd& end);

  const MasterSide& master_;
  NodeEnds ends_;
  SpawnedProcesses processes_;
  HostedPrograms programs_;
  std::vector<WatchedNode> nodes_;  // in the order of their starts
  std::vector<NodeNews> news_;
  bool is_over_ = false, is_ending_ = false;
};

}  // namespace waitpoint::nodes
