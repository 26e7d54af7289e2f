// SPDX-License-Identifier: BSD-3-Clause
// The order of a family's processes in the explored order, as choices of the strategy: before each event of a task, the
// process that executes the next event is chosen among those with an event at this instant. By default the process of
// the last event continues.
//
// As within a process, spinning tasks wait for others: a process whose tasks at this instant all spin is not offered,
// until an event with an effect was executed or all processes spin.
//
// Each process has an explorer of its own; the schedule is one: in the family's memory, each adds its choices to it and
// takes over those of the others.
#pragma once

#include "fibers/explore/report/narrator.hpp"
#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/posix/family/family.hpp"

namespace waitpoint::posix {

/// In the family's memory.
template <class T>
struct SharedSequence {
  T* values;
  std::uint32_t count, room;

  std::span<const T> all() const { return {values, count}; }
};
struct SharedSchedule {
  SharedSequence<exploration::Decision> decisions;
  SharedSequence<exploration::Switch> switches;
  bool cuts_polls_short;  ///< as in exploration::Schedule
  bool parted;            ///< Explorer::parted() of any process
  std::uint32_t last;     ///< the place in the table of the process of the last event
  std::uint64_t effects;  ///< events executed so far that others may wait for
  /// All tasks that a process has at an instant spin, since its last turn.
  struct Spinning {
    Time at;
    std::uint64_t effects;  ///< as many as then, plus one
  } spinning[family::processes_max];
};

/// Sits between the kernel and the process's `decisions`, which record their choices in `explorer`. The narrator, if
/// there is one, describes the choices of processes.
class ProcessChoices final : public kernel::Decisions {
 public:
  /// `begin_in_process` is called in each other process than the first, before its first choice.
  ProcessChoices(kernel::Scheduler& scheduler, exploration::Explorer& explorer, kernel::Decisions& decisions,
                 void (*begin_in_process)(), exploration::Narrator* narrator = nullptr)
      : scheduler_(scheduler),
        explorer_(explorer),
        decisions_(decisions),
        begin_in_process_(begin_in_process),
        narrator_(narrator) {}

  std::uint32_t next(kernel::Task* const* ready, std::uint32_t count) override;
  std::uint32_t among(kernel::Choice choice, const kernel::Task& task, std::uint32_t count) override;
  Duration computing(const kernel::Task& task, Duration least, Duration greatest) override;

  /// The process whose event is the next, if next() has chosen another one, or the process has no event at the instant
  /// of the least and several others have; else null.
  family::Process* take_chosen();

 private:
  void note_spinning(std::span<kernel::Task* const> ready);
  family::Process* choose(bool can_stay);

  kernel::Scheduler& scheduler_;
  exploration::Explorer& explorer_;
  kernel::Decisions& decisions_;
  void (*begin_in_process_)();
  exploration::Narrator* narrator_;
  family::Process* chosen_ = nullptr;
  pid_t process_ = 0;          // the one that the strategy has begun in
  std::uint64_t effects_ = 0;  // those that the explorer knows of
};

}  // namespace waitpoint::posix
