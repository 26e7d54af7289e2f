// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/snapshot_tree.hpp"

#include <algorithm>

namespace waitpoint::tools {
namespace {

using exploration::Deviation;

// Others need to see the run from its beginning.
bool is_of_end_only(const WantedEvidence& wanted) {
  return !wanted.profile && !wanted.learn && !wanted.pairs && !wanted.conflicts && !wanted.words && !wanted.places &&
         !wanted.events && !wanted.decision && !wanted.log_from && !wanted.trail && !wanted.stop_before;
}

// Others also draw, count or learn at events without an alternative. Without a name: the default order.
bool acts_at_choices_only(const std::string& strategy) {
  return strategy.empty() || strategy == "random" || strategy == "fifo";
}

}  // namespace

SnapshotTree::SnapshotTree(std::size_t most, const std::string& strategy) : most_(most), strategy_(strategy) {}

bool SnapshotTree::can_begin(const Plan& plan, const WantedEvidence& wanted) const {
  return most_ > 0 && is_of_end_only(wanted) && acts_at_choices_only(plan.drawing_strategy(strategy_));
}

// True if the run by this plan makes the same choices up to the node. A plan's switches are made wherever they fit:
// with fewer of them than the node's run had, the same ones fit, as long as none is left out that it had made.
bool SnapshotTree::leads_to(const Plan& plan, const Node& node) {
  const std::uint32_t decision = node.snapshot.decision();
  if (plan.until != node.until) return false;
  if (plan.drawn) return decision == 0;
  if (plan.at_random_from && *plan.at_random_from < decision) return false;
  if (!plan.switches.empty()) {
    std::vector<exploration::Switch> asked = plan.switches;
    std::ranges::sort(asked);
    return plan.deviations.empty() && std::ranges::includes(node.asked, asked) &&
           std::ranges::includes(asked, node.made);
  }
  const auto end =
      std::ranges::find_if(plan.deviations, [&](const Deviation& one) { return one.decision >= decision; });
  return std::ranges::equal(plan.deviations.begin(), end, node.deviations.begin(), node.deviations.end());
}

const Snapshot* SnapshotTree::best_for(const Plan& plan, const WantedEvidence& wanted) {
  if (!can_begin(plan, wanted)) return nullptr;
  Node* best = nullptr;
  ++now_;
  for (Node& node : nodes_) {
    if (!leads_to(plan, node)) continue;
    node.used = now_;
    if (best == nullptr || node.snapshot.decision() > best->snapshot.decision()) best = &node;
  }
  return best != nullptr ? &best->snapshot : nullptr;
}

void SnapshotTree::drop(const Snapshot& snapshot) {
  std::erase_if(nodes_, [&](const Node& node) { return &node.snapshot == &snapshot; });
}

// Where there is no room, one of those that do not lead to this run makes room.
SnapshotsAsked SnapshotTree::to_make(const Plan& plan, const WantedEvidence& wanted) const {
  if (!can_begin(plan, wanted)) return {};
  const bool has_others = std::ranges::any_of(nodes_, [&](const Node& node) { return node.used != now_; });
  const std::size_t room = nodes_.size() < most_ ? most_ - nodes_.size() : has_others ? 1 : 0;
  return {static_cast<std::uint32_t>(room), plan.drawn};
}

void SnapshotTree::add(std::vector<Snapshot> made, const Plan& plan, const exploration::Schedule& schedule) {
  for (Snapshot& snapshot : made) {
    const std::uint32_t decision = snapshot.decision();
    if (decision > schedule.decisions.size()) continue;
    Node node{std::move(snapshot), {}, plan.switches, {}, plan.until, now_};
    for (const Deviation& deviation : schedule.deviations())
      if (deviation.decision < decision) node.deviations.push_back(deviation);
    node.made.assign(schedule.switches.begin(),
                     schedule.switches.begin() + static_cast<std::ptrdiff_t>(node.deviations.size()));
    std::ranges::sort(node.asked);
    std::ranges::sort(node.made);
    nodes_.push_back(std::move(node));
  }
  while (nodes_.size() > most_) nodes_.erase(std::ranges::min_element(nodes_, {}, &Node::used));
}

}  // namespace waitpoint::tools
