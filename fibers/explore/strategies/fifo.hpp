// SPDX-License-Identifier: BSD-3-Clause
// The default order: a task continues as long as it can, then the one that has been ready longest; rare alternatives
// are never chosen.
#pragma once

#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

/// The default choice at a switch point.
inline std::uint32_t usual(const SwitchPoint& at) {
  if (at.can_continue)
    for (std::uint32_t i = 0; i < at.ready.size(); ++i)
      if (at.ready[i] == at.last) return i;
  return 0;
}

class Fifo final : public Strategy {
 public:
  void begin(std::uint64_t, const Draws&, const Profile&) override {}
  std::uint32_t next(const SwitchPoint& at) override { return usual(at); }
  std::uint32_t among(Choice, const Task&, std::uint32_t) override { return 0; }
};

}  // namespace waitpoint::exploration
