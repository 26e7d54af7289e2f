// SPDX-License-Identifier: BSD-3-Clause
// Exhaustive search without equivalent schedules: dynamic partial order reduction with sleep sets (Flanagan, Godefroid,
// POPL 2005; Godefroid, LNCS 1032). Two events commute unless they are dependent, see dependence.hpp; the reverse order
// is tried only for dependent events that are not ordered by others.
//
//   ... | state: ready, tried, to try, asleep |--event of one task--> | state | ...
//
// Times are kept: sleeps and timeouts order events of different instants. Choices that are not between tasks are tried
// exhaustively, except spurious wake-ups.
#pragma once

#include <map>

#include "fibers/explore/strategies/schedule.hpp"
#include "fibers/explore/strategies/strategy.hpp"

namespace waitpoint::exploration {

class Dpor final : public Strategy {
 public:
  void begin(std::uint64_t, const Draws&, const Profile&) override;
  std::uint32_t next(const SwitchPoint& at) override;
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;
  bool end() override;
  bool is_exhaustive() const override { return true; }

 private:
  // The pending event of a task.
  struct Event {
    std::uint64_t task = 0;
    kernel::Operation operation = kernel::Operation::start;
    std::uint64_t object = 0;  // identity; 0: none
  };
  static bool are_dependent(const Event& a, const Event& b);

  // By task, the number of its events that happen before: a vector clock.
  using Clock = std::map<std::uint64_t, std::uint32_t>;
  static void join(Clock& into, const Clock& other);

  struct State {
    std::vector<Event> ready;  // empty for a choice that is not between tasks
    std::vector<std::uint64_t> to_try;
    std::vector<std::uint64_t> tried;
    std::vector<Event> asleep;
    Event done;            // the event executed in this state
    std::uint32_t number;  // its number among its task's events
    Clock clock;           // after it
    std::uint32_t count = 0, chosen = 0;
  };

  static Event event_of(const Task& task);
  bool choose(State& state, const State* before);
  void execute(State& state, std::uint64_t maker);
  void find_races(const State& state);
  static void add(std::vector<std::uint64_t>& to, std::uint64_t task);

  std::vector<State> path_;
  std::size_t depth_ = 0;
  std::map<std::uint64_t, std::size_t> last_of_task_;  // the state of each task's last event
};

}  // namespace waitpoint::exploration
