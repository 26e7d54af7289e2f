// SPDX-License-Identifier: BSD-3-Clause
// Random walk: at each switch point a ready task, uniformly. Nothing beats its throughput, but orders in which one task
// waits long are rare.
#pragma once

#include "fibers/explore/strategies/drawn.hpp"

namespace waitpoint::exploration {

class Random final : public Drawn {
 public:
  std::uint32_t next(const SwitchPoint& at) override { return at.ready.size() == 1 ? 0 : draw(at.ready.size()); }
};

}  // namespace waitpoint::exploration
