// SPDX-License-Identifier: BSD-3-Clause
// What stands between the kernel and a strategy: it writes down what is chosen, lets spinning tasks wait for the
// others, ends schedules that do not end, and plays what was chosen before.
//
// A task that looks at the same one or two objects again and again, at one instant and without changing anything (load,
// try_lock, yield, sleeping for no time), waits for others to do something; while any of them can, it is not offered to
// the strategy. So loops that wait for a flag end, whatever the strategy prefers. Where all do so again and again and
// something is due later, they go on then: loops take time, if little.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fibers/explore/strategies/schedule.hpp"
#include "fibers/explore/strategies/strategy.hpp"
#include "fibers/kernel/scheduler.hpp"

namespace waitpoint::exploration {

/// A computation of uncertain cost takes one of so many equally spaced values and one more; the greatest is the usual.
inline constexpr std::uint32_t computing_steps = 64;

/// What is to be played before, or in place of, a strategy.
struct Played {
  /// The first decisions, as long as the run has the alternatives that they had.
  std::span<const Decision> prefix = {};
  /// Behind them: wherever one of these fits, it is made.
  std::span<const Switch> switches = {};
  /// At decisions of these numbers, ascending, these alternatives.
  std::span<const Deviation> deviations = {};
  /// At this decision the run is stopped.
  std::size_t stop_at = ~std::size_t{0};
};

/// What an exhaustive strategy never tried, as none could.
struct LeftOut {
  bool turns = false;     ///< of tasks that spin, while others could go on
  bool costs = false;     ///< of computations, between the values that were offered
  bool spurious = false;  ///< waits that end for nothing
};

class Explorer final : public kernel::Decisions {
 public:
  /// Schedules of `scheduler` end for lack of progress after `steps_max` switch points at one instant.
  Explorer(kernel::Scheduler& scheduler, std::uint32_t steps_max) : scheduler_(scheduler), steps_max_(steps_max) {}

  /// The next schedule is `strategy`'s, which was begun for it, but for what is played.
  void begin(Strategy& strategy, const Played& played = {});

  /// What was chosen in this schedule so far.
  const Schedule& schedule() const { return schedule_; }
  /// Switch points so far.
  std::uint32_t steps() const { return step_; }
  /// The decision at which the run had other alternatives than the prefix, if there was one.
  bool parted() const { return parted_; }
  /// The strategy had it end where nothing new could follow.
  bool was_cut() const { return was_cut_; }
  /// In all schedules so far.
  const LeftOut& left_out() const { return left_out_; }
  /// The tasks between which the run was stopped to choose.
  std::span<Task* const> stopped_before() const { return stopped_before_; }

  /// What alternative number `chosen` of a computation costs.
  static Duration cost(Duration least, Duration greatest, std::uint32_t chosen);

  std::uint32_t next(Task* const* ready, std::uint32_t count) override;
  std::uint32_t among(Choice choice, const Task& task, std::uint32_t count) override;
  Duration computing(const Task& task, Duration least, Duration greatest) override;

 private:
  // What a task did lately, by Task::number.
  struct alignas(32) Habit {
    kernel::Object* at[2] = {};
    std::uint32_t instant = 0;  // of which the rest is
    std::uint8_t looks = 0;
    bool spins = false;
  };

  [[gnu::noinline]] void begin_instant(Time now);
  std::uint32_t place_of_last(std::span<Task* const> offered) const;
  void write_down(Task* const* ready, const Decision& decision);
  [[gnu::noinline]] std::uint32_t next_with_care(Task* const* ready, std::uint32_t count);
  std::uint32_t choose(std::span<Task* const> ready, std::uint32_t usual);
  std::uint32_t stop(std::span<Task* const> ready, std::uint32_t usual);
  std::uint32_t give_up(Task& task);
  bool polls_only(std::span<Task* const> ready) const;
  std::span<Task* const> leave_spinning_out(std::span<Task* const> ready);
  std::uint64_t spinning_among(std::uint32_t count) const;
  void note(const Task& task);
  void note_look(const Task& task, Habit& habit);
  std::uint32_t of_deviations(std::uint32_t count);
  const Decision* of_prefix(Choice choice, std::uint32_t count);
  bool is_played(const Switch& change) const;
  void stop_spinning();

  kernel::Scheduler& scheduler_;
  std::uint32_t steps_max_;
  Strategy* strategy_ = nullptr;
  Played played_;
  bool plays_ = false;
  std::vector<Switch> switches_;  // of what is played, in order: a long run looks for many
  Schedule schedule_;
  std::vector<Habit> habits_;
  std::vector<Task*> offered_;  // of the ready, those that do not spin; and where they stand
  std::vector<std::uint32_t> places_;
  std::vector<Task*> stopped_before_;
  const Task* last_ = nullptr;
  std::uint32_t spinning_ = 0;
  std::uint32_t idle_turns_ = 0;  // given since anybody did something, while all spun
  std::uint32_t step_ = 0;
  std::uint32_t step_of_instant_ = 0;
  Time instant_;
  std::uint32_t instants_ = 0;
  std::size_t deviated_ = 0;  // how many of what is played are past
  bool parted_ = false;
  bool was_cut_ = false;
  LeftOut left_out_;
};

}  // namespace waitpoint::exploration
