// SPDX-License-Identifier: BSD-3-Clause
// A program whose schedule is explored: what is asked of a run, and what becomes known of it. Both lie in the memory
// that the program shares with who asks.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "fibers/explore/report/narrator.hpp"
#include "fibers/explore/report/timeline_recorder.hpp"
#include "fibers/explore/schedules/event_log.hpp"
#include "fibers/explore/schedules/event_stop.hpp"
#include "fibers/explore/schedules/explorer.hpp"
#include "fibers/explore/strategies/profile.hpp"
#include "fibers/sync/source_lines.hpp"

namespace waitpoint::posix {

/// Made by who asks, before the run.
struct Asked {
  static constexpr std::size_t none = ~std::size_t{0};

  /// What the default order has shown, for strategies that are to know.
  struct TaskProfile {
    std::uint64_t task, parent;
    std::uint32_t events;
    std::span<const std::uint64_t> objects;
  };

  char strategy[64] = {};  ///< empty: the default order, but for what follows
  std::uint64_t seed = 0;
  std::uint64_t number = 0;  ///< of the schedule, from which with the seed its draws follow
  std::span<const exploration::Switch> switches = {};
  std::span<const exploration::Deviation> deviations = {};
  std::size_t at_random_from = none;  ///< behind this decision any alternative is taken
  std::uint32_t steps = 0;
  std::span<const TaskProfile> tasks = {};
  std::span<const std::uint64_t> shared = {};
  std::span<const std::uint64_t> code = {};

  bool learn = false;    ///< code that accesses what threads share
  bool profile = false;  ///< what is to be written down
  bool words = false;
  bool events = false;
  Time events_from;
  std::size_t decision = none;
  std::size_t log_from = none;  ///< the events behind this decision are
  bool stops = false;           ///< it is over before an event: what its task is about to do is written down
  exploration::EventOf stop_before;
};

/// All events of a run, as they come. Made by the program, before its first thread.
struct Trace {
  Trace() : recorder(timeline, nullptr) {}

  exploration::Timeline timeline;
  exploration::TimelineRecorder recorder;
};

/// The same where its schedule is explored.
struct Explored {
  /// Decides from now on, as it was asked.
  Explored(kernel::Scheduler& scheduler, const Asked& asked);
  Explored(const Explored&) = delete;
  Explored& operator=(const Explored&) = delete;

  exploration::Explorer explorer;
  exploration::Narrator narrator;
  exploration::Profile known;
  std::unique_ptr<exploration::Strategy> strategy;
  exploration::Profile profile;
  exploration::Timeline timeline;
  std::vector<exploration::DoneEvent> log;
  std::string stopped_before;      ///< an event, in words; empty where the run did not come to it
  sync::CodePlaces stopped_calls;  ///< of its task, without the layer's own

  /// The run is over, maybe where it was to stop.
  void note_stop(kernel::Scheduler& scheduler);

 private:
  void begin(const Asked& asked);
  void watch(kernel::Scheduler& scheduler, const Asked& asked);

  std::optional<exploration::Profiling> profiling_;
  std::optional<exploration::TimelineRecorder> recorder_;
  std::optional<exploration::EventLog> log_;
  std::optional<exploration::EventStop> stop_;
};

}  // namespace waitpoint::posix
