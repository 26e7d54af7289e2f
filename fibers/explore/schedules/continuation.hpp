// SPDX-License-Identifier: BSD-3-Clause
// continuation: the default order up to some decision, then random: tests if a run could still have had another result
// from there.
#pragma once

#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/explore/strategies/fifo.hpp"
#include "fibers/explore/strategies/random.hpp"

namespace waitpoint::exploration {

class Continuation final : public Strategy {
 public:
  /// Random from decision `from` on of the schedule recorded by `explorer`, which must outlive it.
  Continuation(const Explorer& explorer, std::size_t from) : explorer_(explorer), from_(from) {}

  void begin(std::uint64_t number, const Draws& draws, const Profile& profile) override {
    random_.begin(number, draws, profile);
  }
  std::uint32_t next(const SwitchPoint& at) override { return is_behind() ? random_.next(at) : usual_.next(at); }
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override {
    // A failure that a spurious wake-up would avert is not explained by its absence.
    return is_behind() && choice != Choice::spurious ? random_.among(choice, task, count)
                                                     : usual_.among(choice, task, count);
  }

 private:
  bool is_behind() const { return explorer_.schedule().decisions.size() >= from_; }

  const Explorer& explorer_;
  std::size_t from_;
  Random random_;
  Fifo usual_;
};

}  // namespace waitpoint::exploration
