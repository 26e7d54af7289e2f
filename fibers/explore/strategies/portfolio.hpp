// SPDX-License-Identifier: BSD-3-Clause
// Several strategies in turn, one schedule each: no single one finds all bugs. One may have several turns: with
// feedback it learns from all of them.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

class Portfolio final : public Strategy {
 public:
  /// In order of their turns; the same strategy for each of its turns.
  explicit Portfolio(std::vector<std::shared_ptr<Strategy>> turns) : turns_(std::move(turns)) {}

  void begin(std::uint64_t number, const Draws& draws, const Profile& profile) override {
    part_ = &part(number);
    part_->begin(number_of_part(number), draws, profile);
  }
  std::uint64_t first_learned(std::uint64_t from) const override {
    return first(from, [](const Strategy& part, std::uint64_t number) { return part.first_learned(number); });
  }
  std::uint64_t first_held(std::uint64_t from) const override {
    return first(from, [](const Strategy& part, std::uint64_t number) { return part.first_held(number); });
  }
  void hold(std::span<const Constraint> constraints) override {
    for (const auto& part : turns_) part->hold(constraints);
  }
  bool end() override { return part_->end(); }
  Strategy& deciding() override { return *part_; }
  std::uint32_t next(const SwitchPoint& at) override { return part_->next(at); }
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override {
    return part_->among(choice, task, count);
  }

 private:
  template <class FirstOfPart>
  std::uint64_t first(std::uint64_t from, FirstOfPart first_of_part) const {
    for (std::uint64_t number = from; number - from < turns_.size(); ++number) {
      const std::uint64_t of_part = number_of_part(number);
      if (first_of_part(part(number), of_part) == of_part) return number;
    }
    return none;
  }

  Strategy& part(std::uint64_t number) const { return *turns_[number % turns_.size()]; }
  /// The number of its schedule, counted by its own turns.
  std::uint64_t number_of_part(std::uint64_t number) const {
    const auto& of = turns_[number % turns_.size()];
    const auto begin = turns_.begin(), now = begin + static_cast<std::ptrdiff_t>(number % turns_.size());
    const auto of_round = static_cast<std::uint64_t>(std::count(begin, turns_.end(), of));
    return number / turns_.size() * of_round + static_cast<std::uint64_t>(std::count(begin, now, of));
  }

  std::vector<std::shared_ptr<Strategy>> turns_;
  Strategy* part_ = nullptr;
};

}  // namespace waitpoint::exploration
