// SPDX-License-Identifier: BSD-3-Clause
// The snapshots of a program's runs, by the choices that lead to them: a run begins in the one that has most of its
// own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fibers/explore/strategies/schedule.hpp"
#include "tools/exec/snapshots.hpp"
#include "tools/explore/runs/target.hpp"

namespace waitpoint::tools {

class SnapshotTree {
 public:
  /// Keeps at most `most`. `strategy` draws the plans that are drawn and name no other.
  SnapshotTree(std::size_t most, const std::string& strategy);

  /// The snapshot in which this run can begin; null if there is none. Valid up to the next call.
  const Snapshot* best_for(const Plan& plan, const WantedEvidence& wanted);
  /// Drops that one.
  void drop(const Snapshot& snapshot);
  /// What the run is to make.
  SnapshotsAsked to_make(const Plan& plan, const WantedEvidence& wanted) const;
  /// Takes those that the run of this plan has made.
  void add(std::vector<Snapshot> made, const Plan& plan, const exploration::Schedule& schedule);

 private:
  struct Node {
    Snapshot snapshot;
    std::vector<exploration::Deviation> deviations;  // the choices before it that are not the default
    std::vector<exploration::Switch> asked, made;    // the plan's switches, and those made before it, in order
    Time until;
    std::uint64_t used;  // when: the one that was not used for longest is dropped
  };

  bool can_begin(const Plan& plan, const WantedEvidence& wanted) const;
  static bool leads_to(const Plan& plan, const Node& node);

  std::size_t most_;
  std::string strategy_;
  std::uint64_t now_ = 0;
  std::vector<Node> nodes_;
};

}  // namespace waitpoint::tools
