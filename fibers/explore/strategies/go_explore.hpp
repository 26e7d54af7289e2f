// SPDX-License-Identifier: BSD-3-Clause
// Go-Explore: feedback from the states that schedules pass (Ecoffet, Huizinga, Lehman, Stanley, Clune, "First return,
// then explore", Nature 2021). Of each abstract state (abstract_state.hpp) the choices that lead there are kept. Most
// schedules repeat those of a rare state, then follow the priorities of POS. So a failure behind several rare states is
// reached from one to the next: the schedules that it takes add up, where without feedback they multiply.
//
// Each schedule depends on those before it: see Strategy::first_learned().
#pragma once

#include <memory>
#include <unordered_map>

#include "fibers/explore/strategies/abstract_state.hpp"
#include "fibers/explore/strategies/pos.hpp"

namespace waitpoint::exploration {

class GoExplore final : public Drawn {
 public:
  std::uint32_t next(const SwitchPoint& at) override;
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;
  bool lets_poll_on() override;
  bool end() override;
  std::uint64_t first_learned(std::uint64_t from) const override { return from; }

 private:
  using Choices = std::vector<std::uint32_t>;
  /// A state that a schedule passes, before its choice number `length`.
  struct Passed {
    std::uint64_t state;
    std::size_t length;
  };
  struct Kept {
    std::uint64_t state;
    std::shared_ptr<const Choices> choices;  // of the schedule that passed it first
    std::size_t length;                      // the first of them lead to the state
    std::uint64_t times;                     // the schedules that passed it or returned to it
    std::uint64_t last;                      // the number of the last of them
  };

  void start(const Profile& profile) override;
  Kept& rare_one();
  bool returns(std::uint32_t count);
  template <class Drawing>
  std::uint32_t choose(std::uint32_t count, Drawing drawing);
  void keep(const Passed& passed, const std::shared_ptr<const Choices>& choices);

  static constexpr std::size_t kept_max = 100'000, choices_max = 16'000'000;  // the latter of all that are kept
  static constexpr int compared = 8;
  static constexpr std::uint32_t one_in_from_start = 4;

  EventPriorities priorities_;
  AbstractState state_;
  Choices choices_;                     // of this schedule
  std::shared_ptr<const Choices> way_;  // the choices that it repeats,
  std::size_t way_length_ = 0;          // up to this number
  std::vector<Passed> passed_;          // by this schedule
  std::uint64_t schedules_ = 0;

  std::vector<Kept> kept_;
  std::unordered_map<std::uint64_t, std::size_t> place_;  // in kept_, by state
};

}  // namespace waitpoint::exploration
