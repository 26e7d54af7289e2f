// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/dfs.hpp"

#include <algorithm>

#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::exploration {

void Dfs::begin(std::uint64_t, const Draws&, const Profile&) {
  depth_ = 0;
  preempted_ = 0;
}

// The alternative on the path, or the first one of a new level.
std::uint32_t Dfs::descend(std::uint32_t count) {
  if (depth_ == path_.size()) path_.push_back({count, 0});
  // A body that leaks state may have different alternatives: this level restarts.
  Level& level = path_[depth_++];
  if (level.count != count) {
    path_.resize(depth_);
    path_.back() = {count, 0};
  }
  return path_[depth_ - 1].tried;
}

// The default one first, then the others in order.
std::uint32_t Dfs::next(const SwitchPoint& at) {
  const std::uint32_t first = usual(at);
  const bool may_switch = !at.can_continue || preempted_ < preemptions_;
  if (at.ready.size() == 1 || !may_switch) return first;
  const std::uint32_t tried = descend(static_cast<std::uint32_t>(at.ready.size()));
  if (tried == 0) return first;
  preempted_ += at.can_continue;
  return tried <= first ? tried - 1 : tried;
}

std::uint32_t Dfs::among(Choice choice, const Task&, std::uint32_t count) {
  if (choice == Choice::spurious) return 0;  // spurious wake-ups could be endless
  if (choice == Choice::computing) return descend(2) == 0 ? 0 : count - 1;
  return descend(count);
}

bool Dfs::end() {
  path_.resize(depth_);
  while (!path_.empty() && path_.back().tried + 1 == path_.back().count) path_.pop_back();
  if (path_.empty()) return false;
  ++path_.back().tried;
  return true;
}

namespace {

// The alternatives of a decision in the order in which they are tried: the default one, then the others that were
// offered; of a cost the two ends.
std::vector<std::uint32_t> tried_in_order(const Decision& decision) {
  if (decision.choice == Choice::computing) return {0, decision.count - 1};
  std::vector<std::uint32_t> order = {decision.usual};
  for (std::uint32_t i = 0; i < decision.count; ++i)
    if (i != decision.usual && !decision.spins(i)) order.push_back(i);
  return order;
}

}  // namespace

void Dfs::resume(std::span<const Decision> choices) {
  resumed_.assign(choices.begin(), choices.end());
  path_.clear();
  at_.clear();
  preempted_ = 0;
  for (std::uint32_t at = 0; at < choices.size(); ++at) {
    const Decision& decision = choices[at];
    if (decision.choice == Choice::spurious || (decision.can_continue && preempted_ == preemptions_)) continue;
    preempted_ += decision.can_continue && decision.is_switch();
    const std::vector<std::uint32_t> order = tried_in_order(decision);
    const auto chosen = std::find(order.begin(), order.end(), decision.chosen);
    path_.push_back({static_cast<std::uint32_t>(order.size()), static_cast<std::uint32_t>(chosen - order.begin())});
    at_.push_back(at);
  }
  depth_ = path_.size();
}

std::vector<Deviation> Dfs::deviations() const {
  std::vector<Deviation> deviations;
  if (path_.empty()) return deviations;
  const std::uint32_t last = at_[path_.size() - 1];
  for (std::uint32_t at = 0; at < last; ++at)
    if (resumed_[at].is_switch()) deviations.push_back({at, resumed_[at].chosen});
  deviations.push_back({last, tried_in_order(resumed_[last])[path_.back().tried]});
  return deviations;
}

std::string Dfs::scope() const {
  if (preemptions_ == unbounded) return "";
  return " with at most " + std::to_string(preemptions_) + (preemptions_ == 1 ? " preemption" : " preemptions");
}

}  // namespace waitpoint::exploration
