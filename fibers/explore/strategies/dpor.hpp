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
    std::uint64_t object = 0;             // identity; 0: none
    bool is_on_shared_processor = false;  // its turn delays the others', by an order that depends on their priorities
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
    Event done;                 // the event executed in this state
    std::uint64_t sequence;     // its task's events so far, as the kernel counts them
    std::uint32_t instant = 0;  // the number of its instant
    std::uint32_t number;       // its number among its task's events
    Clock clock;                // after it
    std::uint32_t count = 0, chosen = 0;

    bool is_of_task() const { return !ready.empty(); }
    bool is_ready(std::uint64_t task) const;
    bool happens_before(const Clock& at) const;
  };

  static Event event_of(const Task& task);
  bool choose(State& state, const State* before);
  void execute(State& state, const Task& task);
  Clock clock_of_making(const Task& task) const;
  std::vector<std::size_t> racing_with(State& state) const;
  void try_without(std::size_t event);
  void try_those_left_at_the_end();
  static void add(std::vector<std::uint64_t>& to, std::uint64_t task);

  std::vector<State> path_;
  std::size_t depth_ = 0;
  std::uint32_t instants_ = 0;
  std::map<std::uint64_t, std::size_t> last_of_task_;  // the state of each task's last event
  bool was_cut_ = false;
};

}  // namespace waitpoint::exploration
