// SPDX-License-Identifier: BSD-3-Clause
// POS: partial order sampling (Yuan, Yang, Gu, "Partial order aware concurrency sampling", CAV 2018). Each pending
// event has a random priority; the highest executes, and those that race with it, at the same object, redraw. So both
// orders of two racing events are equally likely, however far apart they are.
#pragma once

#include "fibers/explore/strategies/drawn.hpp"

namespace waitpoint::exploration {

class Pos final : public Drawn {
 public:
  std::uint32_t next(const SwitchPoint& at) override;

 private:
  void start(const Profile&) override { pending_.clear(); }

  struct Pending {
    std::uint64_t sequence = ~std::uint64_t{0};  // the event of the priority
    std::uint64_t priority = 0;
  };
  std::vector<Pending> pending_;  // by Task::number
};

}  // namespace waitpoint::exploration
