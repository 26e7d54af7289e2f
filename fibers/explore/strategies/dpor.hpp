// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive search without equivalent schedules: dynamic partial order reduction by source sets, with sleep sets
// (Abdulla, Aronis, Jonsson, Sagonas, "Optimal dynamic partial order reduction", POPL 2014, algorithm 1; Flanagan,
// Godefroid, POPL 2005; Godefroid, LNCS 1032). Two events commute unless they are dependent, see dependence.hpp; the
// reverse order is tried only for dependent events that are not ordered by others: these race.
//
//   ... | state: ready, tried, to try, asleep |--event of one task--> | state | ...
//
// Times are kept: events of different instants do not race. An event that ends the run is tried after those of all
// other ready tasks. Choices that are not between tasks are tried exhaustively, except spurious wake-ups.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "fibers/explore/strategies/dpor_path.hpp"
#include "fibers/explore/strategies/schedule.hpp"
#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

/// What a search by dpor covers, where that may not be assumed.
inline constexpr const char* up_to_equivalence = " up to the order of independent events, if there are no data races";

class Dpor final : public Strategy {
 public:
  void begin(std::uint64_t, const Draws&, const Profile&) override;
  std::uint32_t next(const SwitchPoint& at) override;
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;
  bool end() override;
  bool is_exhaustive() const override { return true; }

  /// The search up to now, after a schedule, as numbers: another process may resume it, and continues with end(); or,
  /// after end(), with begin().
  std::vector<std::uint64_t> progress() const;
  void resume(std::span<const std::uint64_t> progress);

 private:
  using Event = dpor::Event;
  using Clock = dpor::Clock;
  using State = dpor::State;

  static void join(Clock& into, const Clock& other);
  bool choose(State& state, const State* before);
  void execute(State& state, const Task& task);
  Clock clock_of_making(const Task& task) const;
  std::vector<std::size_t> racing_with(State& state) const;
  void try_without(std::size_t event);
  void try_those_left_at_the_end();
  static void add(std::vector<std::uint64_t>& to, std::uint64_t task);

  dpor::Path path_;
  std::size_t depth_ = 0;
  std::uint32_t instants_ = 0;
  std::map<std::uint64_t, std::size_t> last_of_task_;  // the state of each task's last event
  bool was_cut_ = false;
  Memory memory_ = Memory::sc;
};

}  // namespace waitpoint::exploration
