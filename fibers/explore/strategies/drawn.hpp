// SPDX-License-Identifier: BSD-3-Clause
// What strategies share that draw their choices: all but which task goes on.
#pragma once

#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

class Drawn : public Strategy {
 public:
  void begin(std::uint64_t, const Draws& draws, const Profile& profile) override {
    draws_ = draws;
    start(profile);
  }
  /// Any waiter; now and then something that rarely happens; of what a computation may cost, the ends as often as all
  /// between them: bugs of timing are at the ends.
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;

 protected:
  /// The schedule begins; the draws are its own already.
  virtual void start(const Profile&) {}

  std::uint32_t draw(std::size_t bound) { return static_cast<std::uint32_t>(draws_.below(bound)); }
  Draws draws_;
};

}  // namespace waitpoint::exploration
