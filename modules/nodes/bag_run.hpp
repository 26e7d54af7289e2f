// SPDX-License-Identifier: BSD-3-Clause
// A run without a world: the messages of a bag go to nodes at their times. Nodes start; when all are there, and the
// delay is over, the bag begins; the run ends when its nodes have ended or, after the last message, are idle.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/digest.hpp"
#include "modules/nodes/bag_side.hpp"
#include "modules/nodes/node_processes.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::nodes {

/// The messages that nodes published to a topic: the digest is that of the publishers' names and bytes, in the order in
/// which the run heard them.
struct HeardTopic {
  std::string type;
  std::uint64_t messages = 0;
  Digest digest;
};

struct BagResult {
  enum class End : unsigned char { idle, latest, nodes_ended, required_ended, limit, interrupted };

  End end = End::idle;
  bool is_played = false;  ///< to its end
  Duration played;         ///< of the bag's time
  Duration simulated;
  std::vector<TopicCount> topics;           ///< played
  std::map<std::string, HeardTopic> heard;  ///< by topic
  std::uint64_t faults = 0;                 ///< of nodes
};

class BagRun {
 public:
  struct Surroundings {
    std::function<bool(Time)> wait_until;  ///< virtual time; false: the run is to end
    std::function<void(Time, const NodeNews&)> tell;
  };

  /// `play` and `surroundings` must outlive this.
  BagRun(const scenario::PlayScenario& play, bool has_clock, std::unique_ptr<BagSide> bag,
         std::vector<NodeCommand> commands, const Surroundings& surroundings);

  /// Once. Nodes have ended when it returns. Throws std::runtime_error if the bag cannot be read.
  BagResult run(Time limit);

 private:
  using End = BagResult::End;

  std::optional<End> start();
  std::optional<End> play();
  End wind_down();
  std::optional<End> go_on(Time until);
  std::optional<End> look_after_nodes();
  void hear();
  Time in_run(std::int64_t bag_ns) const;

  const scenario::PlayScenario& play_;
  bool has_clock_;
  std::unique_ptr<BagSide> bag_;
  NodeProcesses processes_;  // end before the master
  const Surroundings& surroundings_;
  BagResult result_;
  Time limit_, now_, begin_, next_look_, last_heard_;
  std::int64_t clock_ticks_ = 0;
  bool is_begun_ = false;
};

}  // namespace waitpoint::nodes
