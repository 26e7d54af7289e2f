// SPDX-License-Identifier: BSD-3-Clause
// Choices from a fuzzer's input: a byte each, modulo the alternatives; then the default order. So every input is a
// schedule, and a truncated input a simpler one.
#pragma once

#include <span>

#include "fibers/explore/strategies/fifo.hpp"

namespace waitpoint::exploration {

class Bytes final : public Strategy {
 public:
  /// `input` must outlive it.
  explicit Bytes(std::span<const std::uint8_t> input) : input_(input) {}

  void begin(std::uint64_t, const Draws&, const Profile&) override { used_ = 0; }
  std::uint32_t next(const SwitchPoint& at) override {
    if (at.ready.size() == 1) return 0;
    // Zero is the default choice, so a fuzzer's zero padding changes little.
    return used_ == input_.size() ? usual(at) : (usual(at) + take(at.ready.size())) % at.ready.size();
  }
  std::uint32_t among(Choice, const Task&, std::uint32_t count) override {
    return used_ == input_.size() ? 0 : take(count);
  }

 private:
  std::uint32_t take(std::size_t count) { return static_cast<std::uint32_t>(input_[used_++] % count); }

  std::span<const std::uint8_t> input_;
  std::size_t used_ = 0;
};

}  // namespace waitpoint::exploration
