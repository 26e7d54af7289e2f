// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/explore/strategies/pct.hpp"

#include <algorithm>

namespace waitpoint::exploration {

void Pct::start(const Profile& profile) {
  priorities_.clear();
  changes_.clear();
  changed_ = 0;
  for (std::uint32_t i = 1; i < depth_; ++i) changes_.push_back(draw(profile.steps + 1));
  std::sort(changes_.begin(), changes_.end());
}

std::uint32_t Pct::most_urgent(const SwitchPoint& at) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 0; i < at.ready.size(); ++i) {
    while (priorities_.size() <= at.ready[i]->number) priorities_.push_back(depth_ + (draws_.bits() >> 1));
    if (priorities_[at.ready[i]->number] > priorities_[at.ready[best]->number]) best = i;
  }
  return best;
}

std::uint32_t Pct::next(const SwitchPoint& at) {
  std::uint32_t best = most_urgent(at);
  while (changed_ < changes_.size() && at.step >= changes_[changed_]) {
    priorities_[at.ready[best]->number] = depth_ - ++changed_;
    best = most_urgent(at);
  }
  return best;
}

}  // namespace waitpoint::exploration
