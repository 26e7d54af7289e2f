// SPDX-License-Identifier: BSD-3-Clause
// The explorer sits between the kernel and a strategy: it records the choices, delays spinning tasks, ends schedules
// that make no progress, and plays back recorded choices.
//
// A task that polls the same one or two objects repeatedly, at one instant and without changing anything (load,
// try_lock, yield, sleeping for no time), waits for others; while any of them can run, it is not offered to the
// strategy. So polling loops end under every strategy. Some loops poll a number of times and then wait otherwise: a
// strategy may let the task go on alone up to that wait, in at most polls_max turns. If all tasks spin and an event is
// due later, time advances to it: loops take time, if little.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "fibers/explore/schedules/trace_hash.hpp"
#include "fibers/explore/strategies/reads_from.hpp"
#include "fibers/explore/strategies/schedule.hpp"
#include "fibers/explore/strategies/strategy.hpp"
#include "fibers/kernel/task.hpp"

namespace waitpoint::exploration {

/// A computation of uncertain cost takes one of computing_steps + 1 equally spaced values; the greatest is the default.
inline constexpr std::uint32_t computing_steps = 64;

/// A recorded schedule, played before, or instead of, a strategy.
struct Played {
  /// The first decisions, while the run has the same alternatives.
  std::span<const Decision> prefix = {};
  /// After them: switches, each made wherever it fits, the first of those that do.
  std::span<const Switch> switches = {};
  /// Alternatives at decisions of these numbers, ascending.
  std::span<const Deviation> deviations = {};
  /// The run is stopped at this decision.
  std::size_t stop_at = ~std::size_t{0};
};

/// True if the pending event has no effect on others, as those that tasks repeat when they poll.
bool is_look(const Task& task);

class Explorer final : public kernel::Decisions {
 public:
  /// Schedules of `scheduler` end with no progress after `steps_max` switch points at one instant. `memory` is that of
  /// instrumented code.
  Explorer(kernel::Scheduler& scheduler, std::uint32_t steps_max, Memory memory = Memory::sc)
      : scheduler_(scheduler), steps_max_(steps_max), trace_(memory) {}

  /// Starts the next schedule: first `played`, then `strategy`, which must have begun this schedule.
  void begin(Strategy& strategy, const Played& played = {});
  /// Records the relation of the following schedules, of each by itself; null: no more.
  void record(ReadsFromRelation* relation) { relation_ = relation; }

  /// Continues the schedule with `played`, as far as it is about decisions to come, and then this strategy, which must
  /// have begun.
  void play(Strategy& strategy, const Played& played);
  /// Continues with this strategy, which must have begun.
  void decide_by(Strategy& strategy) { strategy_ = &strategy.deciding(); }

  /// The choices of this schedule so far.
  const Schedule& schedule() const { return schedule_; }
  /// Equal for schedules that differ in the order of independent events only; of this process.
  std::uint64_t trace() const { return trace_.value(); }
  /// Switch points so far.
  std::uint32_t steps() const { return step_; }
  /// True if the run diverged from the prefix: a decision had other alternatives.
  bool parted() const { return parted_; }
  /// True if a task of this schedule has polled so long that strategies were asked about it.
  bool has_spun() const { return has_spun_; }
  /// True if the strategy abandoned it, since nothing new could follow.
  bool was_cut() const { return was_cut_; }
  /// True if this schedule has taken an alternative that exhaustive strategies omit.
  bool is_beyond_enumeration() const { return is_beyond_enumeration_; }
  /// The candidates of the decision at which the run was stopped.
  std::span<Task* const> stopped_before() const { return stopped_before_; }

  /// The cost of alternative `chosen` of a computation.
  static Duration cost(Duration least, Duration greatest, std::uint32_t chosen);

  std::uint32_t next(Task* const* ready, std::uint32_t count) override;
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;
  Duration computing(const Task& task, Duration least, Duration greatest) override;

  /// One of `count` processes, at least 2, the default first; `task` is any of this one's. The last `spinning` of them,
  /// not all, are not offered. `can_continue`: the default one executed the last event.
  std::uint32_t process(const Task& task, std::uint32_t count, std::uint32_t spinning, bool can_continue);
  /// True if all of these tasks spin: another process may go first.
  bool spin(std::span<Task* const> ready) const;
  /// An event with an effect was executed in another process: tasks that spin may have what they wait for.
  void note_effect_elsewhere();
  /// Appends choices that were made in another process.
  void take_over(std::span<const Decision> decisions, std::span<const Switch> switches);

 private:
  std::uint32_t alternative(Decision decision, const Task& task, std::uint32_t offered, std::uint64_t time);
  // A task's recent accesses, by Task::number: at objects, or at the places of calls.
  struct alignas(32) RecentAccesses {
    std::uintptr_t at[2] = {};
    std::uint32_t instant = 0;  // the instant to which the other members apply
    std::uint8_t looks = 0;
    bool spins = false;
  };

  [[gnu::noinline]] void begin_instant(Time now);
  std::uint32_t place_of_last(std::span<Task* const> offered) const;
  void record_choice(Task* const* ready, const Decision& decision);
  [[gnu::noinline]] std::uint32_t next_with_care(Task* const* ready, std::uint32_t count);
  std::uint32_t choose(std::span<Task* const> ready, std::uint32_t usual);
  std::uint32_t stop(std::span<Task* const> ready, std::uint32_t usual);
  std::uint32_t abandon_schedule(Task& task);
  bool polls_only(std::span<Task* const> ready) const;
  std::span<Task* const> leave_spinning_out(std::span<Task* const> ready);
  std::uint64_t spinning_among(std::uint32_t count) const;
  std::uint32_t place_of_poller(std::span<Task* const> ready);
  void note(const Task& task);
  void note_look(const Task& task, RecentAccesses& habit);
  std::uint32_t of_deviations(std::uint32_t count);
  const Decision* of_prefix(Choice choice, std::uint32_t count);
  std::size_t place_of(const Switch& change) const;
  void stop_spinning();

  kernel::Scheduler& scheduler_;
  std::uint32_t steps_max_;
  Strategy* strategy_ = nullptr;
  Played played_;
  bool plays_ = false;
  std::vector<std::pair<Switch, std::size_t>> switches_;  // those to play, with their places; sorted, to be searched
  Schedule schedule_;
  TraceHash trace_;
  ReadsFromRelation* relation_ = nullptr;
  std::vector<RecentAccesses> habits_;
  std::vector<Task*> offered_;  // the ready tasks that do not spin, and their indices
  std::vector<std::uint32_t> places_;
  std::vector<Task*> stopped_before_;
  EventOf of_process_;  // of the last choice among processes, and the number of those before the same event
  std::uint64_t times_ = 0;
  const Task* last_ = nullptr;
  std::uint32_t spinning_ = 0;
  const Task* poller_ = nullptr;  // goes on alone
  std::uint32_t polls_ = 0;       // its turns
  std::uint32_t idle_turns_ = 0;  // turns given since the last effect, while all tasks spin
  std::uint32_t step_ = 0;
  std::uint32_t step_of_instant_ = 0;
  Time instant_;
  std::uint32_t instants_ = 0;
  std::size_t deviated_ = 0;  // number of deviations played already
  bool parted_ = false;
  bool was_cut_ = false;
  bool is_beyond_enumeration_ = false;
  bool has_spun_ = false;
};

}  // namespace waitpoint::exploration
