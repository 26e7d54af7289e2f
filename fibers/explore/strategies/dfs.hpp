// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive depth-first search: after each schedule the last choice with an untried alternative takes it. The bounded
// variant tries all schedules with at most a given number of preemptions, i.e. switches away from a task that could
// continue (Musuvathi, Qadeer, "Iterative context bounding", PLDI 2007): most bugs need two or three.
//
// Of the cost of a computation it tries the two ends.
#pragma once

#include <span>
#include <vector>

#include "fibers/explore/strategies/schedule.hpp"
#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

class Dfs final : public Strategy {
 public:
  static constexpr std::uint32_t unbounded = 0xFFFFFFFF;

  explicit Dfs(std::uint32_t preemptions = unbounded) : preemptions_(preemptions) {}

  void begin(std::uint64_t, const Draws&, const Profile&) override;
  std::uint32_t next(const SwitchPoint& at) override;
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;
  bool end() override;
  bool is_exhaustive() const override { return true; }
  std::string scope() const override;

  /// The choices of a schedule that another process has run, in the default order but for deviations(): the search
  /// continues with end().
  void resume(std::span<const Decision> choices);
  /// After that: the next schedule.
  std::vector<Deviation> deviations() const;

 private:
  struct Level {
    std::uint32_t count;
    std::uint32_t tried;  // the alternative on the present path
  };
  std::uint32_t descend(std::uint32_t count);

  std::uint32_t preemptions_;
  std::vector<Level> path_;
  std::size_t depth_ = 0;
  std::uint32_t preempted_ = 0;
  std::vector<Decision> resumed_;  // all choices of the resumed schedule
  std::vector<std::uint32_t> at_;  // the choice of each level
};

}  // namespace waitpoint::exploration
