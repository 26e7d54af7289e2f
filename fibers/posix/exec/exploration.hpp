// SPDX-License-Identifier: BSD-3-Clause
// A program whose schedule is explored: the request for a run, and its results. Both are in the memory that the program
// shares with the explorer's process.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "fibers/explore/schedules/course.hpp"
#include "fibers/explore/schedules/event_log.hpp"
#include "fibers/explore/schedules/event_stop.hpp"
#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/posix/exec/process_choices.hpp"
#include "fibers/posix/reports/history.hpp"
#include "fibers/posix/traps/access_instruction.hpp"
#include "fibers/sync/report/source_lines.hpp"

namespace waitpoint::posix {

/// The request, made by the explorer's process before the run.
struct Asked {
  static constexpr std::size_t none = ~std::size_t{0};

  /// Learned from a run in the default order, for strategies that need it.
  struct TaskProfile {
    std::uint64_t task, parent;
    std::uint32_t events;
    std::span<const std::uint64_t> objects;
  };

  char strategy[64] = {};  ///< empty: the default order, except for `switches` and `deviations`
  std::uint64_t seed = 0;
  std::uint64_t number = 0;  ///< of the schedule: its random draws follow from this and the seed
  std::span<const exploration::Switch> switches = {};
  std::span<const exploration::Deviation> deviations = {};
  std::span<const std::uint64_t> progress = {};               ///< as in exploration::Course; of the first process only
  std::span<const exploration::Constraint> constraints = {};  ///< the same
  std::size_t at_random_from = none;  ///< after this decision, alternatives are chosen at random
  std::uint32_t steps = 0;
  std::span<const TaskProfile> tasks = {};
  std::span<const std::uint64_t> shared = {};
  std::span<const std::uint64_t> code = {};
  std::span<const AccessInstruction> accesses = {};  ///< instructions with breakpoints: begin_access_log()
  std::span<const AccessLibrary> libraries = {};     ///< the files of those that are not the program's

  Memory memory = Memory::sc;  ///< of instrumented code

  bool learn = false;      ///< record the code that accesses shared memory
  bool notes = false;      ///< log whether other code does
  bool conflicts = false;  ///< log accesses of several threads to the same memory that no event orders
  bool pairs = false;      ///< record the reads-from relation, of the first process
  bool profile = false;    ///< record the profile
  bool words = false;      ///< record choices in words
  bool events = false;     ///< record events, from `events_from` on
  Time events_from;
  std::size_t decision = none;
  std::size_t log_from = none;  ///< log the events after this decision
  bool stops = false;           ///< stop before an event, and record its task's operation
  exploration::EventOf stop_before;
};

/// A request that programs which are started later can read, in the family's memory: without what is about the first
/// process's events only.
const Asked* shared_copy(const Asked& asked);

/// The results of a run whose schedule is explored.
struct Explored {
  /// Makes the scheduler's decisions from now on, as requested.
  Explored(kernel::Scheduler& scheduler, const Asked& asked);
  Explored(const Explored&) = delete;
  Explored& operator=(const Explored&) = delete;

  exploration::Explorer explorer;
  HistoryNarrator narrator;
  std::optional<ProcessChoices> processes;
  exploration::Profile known;
  std::unique_ptr<exploration::Strategy> strategy;
  exploration::ReadsFromRelation relation;  ///< if it is asked for
  exploration::Profile profile;
  std::vector<exploration::DoneEvent> log;
  std::optional<HistoryRecorder> recorder;  ///< if events are asked for
  std::string stopped_before;               ///< an event, in words; empty if the run did not reach it
  sync::CodePlaces stopped_calls;           ///< its task's call stack, without the layer's own frames

  /// After the run: notes if it has stopped where requested.
  void note_stop();
  /// In a run that begins at a decision of an earlier one: makes the choices as requested from there on.
  void begin_again(const Asked& asked);
  /// Makes the choices of another process from now on: its random ones differ.
  void continue_in_process(const Asked& asked);

 private:
  void begin(const Asked& asked);
  void begin_course(const Asked& asked);
  exploration::Course course_of(const Asked& asked) const;
  void watch(kernel::Scheduler& scheduler, const Asked& asked);

  std::optional<exploration::Profiling> profiling_;
  std::optional<exploration::EventLog> log_;
  std::optional<exploration::EventStop> stop_;
};

}  // namespace waitpoint::posix
