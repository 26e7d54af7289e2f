// SPDX-License-Identifier: BSD-3-Clause
// Several strategies in turn, one schedule each: no single one finds all bugs.
#pragma once

#include <memory>
#include <vector>

#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

class Portfolio final : public Strategy {
 public:
  explicit Portfolio(std::vector<std::unique_ptr<Strategy>> parts) : parts_(std::move(parts)) {}

  void begin(std::uint64_t number, const Draws& draws, const Profile& profile) override {
    part_ = parts_[number % parts_.size()].get();
    part_->begin(number / parts_.size(), draws, profile);
  }
  std::uint64_t first_learned(std::uint64_t from) const override {
    for (std::uint64_t number = from; number - from < parts_.size(); ++number) {
      const std::uint64_t of_part = number / parts_.size();
      if (parts_[number % parts_.size()]->first_learned(of_part) == of_part) return number;
    }
    return none;
  }
  void hold(std::span<const Constraint> constraints) override {
    for (const auto& part : parts_) part->hold(constraints);
  }
  bool end() override { return part_->end(); }
  Strategy& deciding() override { return *part_; }
  std::uint32_t next(const SwitchPoint& at) override { return part_->next(at); }
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override {
    return part_->among(choice, task, count);
  }

 private:
  std::vector<std::unique_ptr<Strategy>> parts_;
  Strategy* part_ = nullptr;
};

}  // namespace waitpoint::exploration
