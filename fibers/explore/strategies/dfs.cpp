// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/dfs.hpp"

#include "core/error.hpp"
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

std::string Dfs::scope() const {
  if (preemptions_ == unbounded) return "";
  return " with at most " + std::to_string(preemptions_) + (preemptions_ == 1 ? " preemption" : " preemptions");
}

}  // namespace waitpoint::exploration
