// SPDX-License-Identifier: BSD-3-Clause
// PCT: random priorities that change at a few random steps (Burckhardt, Kothari, Musuvathi, Nagarakatti, "A randomized
// scheduler with probabilistic guarantees of finding bugs", ASPLOS 2010). The ready task of the highest priority runs;
// at each of depth - 1 steps, drawn beforehand, the task that would run drops below all others. A bug that needs
// `depth` orderings among n tasks and k steps is found with a probability of at least 1 / (n k^(depth-1)).
#pragma once

#include "fibers/explore/strategies/drawn.hpp"

namespace waitpoint::exploration {

class Pct final : public Drawn {
 public:
  explicit Pct(std::uint32_t depth) : depth_(depth) {}
  std::uint32_t next(const SwitchPoint& at) override;

 private:
  void start(const Profile& profile) override;
  std::uint32_t most_urgent(const SwitchPoint& at);

  std::uint32_t depth_;
  std::vector<std::uint32_t> changes_;     // steps, ascending
  std::size_t changed_ = 0;                // number of changes made
  std::vector<std::uint64_t> priorities_;  // by Task::number; below depth_ after a drop
};

}  // namespace waitpoint::exploration
