// SPDX-License-Identifier: BSD-3-Clause
// The common part of drawing strategies: all choices except the next task.
#pragma once

#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

class Drawn : public Strategy {
 public:
  void begin(std::uint64_t, const Draws& draws, const Profile& profile) override {
    draws_ = draws;
    start(profile);
  }
  /// Any waiter; now and then a rare alternative; of a computation's costs, the ends as often as all values between:
  /// timing bugs are at the ends; the newest value as often as all older ones.
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;
  /// One in four: most loops poll until another task acts, few a number of times before they wait.
  bool lets_poll_on() override { return draw(4) == 0; }

 protected:
  /// Called at the start of a schedule, after its draws are set.
  virtual void start(const Profile&) {}

  std::uint32_t draw(std::size_t bound) { return static_cast<std::uint32_t>(draws_.below(bound)); }
  Draws draws_;
};

}  // namespace waitpoint::exploration
