// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/runs/switch_points.hpp"

#include "fibers/explore/strategies/factory.hpp"

namespace waitpoint::tools {

SwitchAt switch_points_of(const exploration::Plan& plan, const ExploreOptions& options, bool at_accesses) {
  if (options.switch_at != SwitchAt::automatic) return options.switch_at;
  if (options.snapshots > 0 || !plan.drawn || options.strategy == "fifo" ||
      exploration::make_strategy(options.strategy)->is_exhaustive())
    return SwitchAt::calls;
  constexpr std::uint64_t in_turn = 10;
  const std::uint64_t turn = plan.number / in_turn;
  const bool is_at_accesses = at_accesses ? turn % 4 != 1 : turn >= 2 && turn % 2 == 0;
  return is_at_accesses ? SwitchAt::accesses : SwitchAt::calls;
}

ExploreOptions with_switches_at(SwitchAt at, const ExploreOptions& options) {
  ExploreOptions result = options;
  if (at != SwitchAt::automatic) result.switch_at = at;
  return result;
}

}  // namespace waitpoint::tools
