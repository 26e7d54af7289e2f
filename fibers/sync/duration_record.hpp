// SPDX-License-Identifier: BSD-3-Clause
// The durations of a run that do not follow from its scenario and seed: measured, counted or chosen by local clocks.
//
// They are recorded in the order in which they were charged. A run that reads them back in that order is the same run,
// on any machine. As text:
//
//   waitpoint durations 1
//   run 5f0d97a1c0ffee42 seed 7         hash of the scenario with its settings, and the seed
//   task 1 8c0d2f0a9b3e4f55 r0.motion   introduces a task, before its first duration
//   1 15322                             of task 1: 15 322 ns
//   1 900
//   end 2                               the number of durations; a record without this line is truncated
//   # cut off: ...                      the run died, for this reason: it is repeated up to there
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "fibers/kernel/local_clock.hpp"
#include "fibers/sync/simulation.hpp"

namespace waitpoint {

struct DurationRecord {
  struct TaskName {
    std::uint64_t id = 0;  ///< the kernel's, from robot and creation path
    std::string name;
    friend bool operator==(const TaskName&, const TaskName&) = default;
  };
  struct Entry {
    std::uint32_t task = 0;  ///< index into `tasks`
    std::int64_t ns = 0;
    friend bool operator==(const Entry&, const Entry&) = default;
  };
  std::string run;  ///< identifies the run of the record, in one line
  std::vector<TaskName> tasks;
  std::vector<Entry> entries;
  std::string cut_off;  ///< empty: of a run that ended

  friend bool operator==(const DurationRecord&, const DurationRecord&) = default;
};

std::string to_text(const DurationRecord& record);

/// Throws BadInput, naming `file` and the line, for a malformed or truncated record.
DurationRecord parse_duration_record(const std::string& file, std::string_view text);

/// Records the durations of a run; must outlive it.
class DurationRecorder : private kernel::Durations {
 public:
  DurationRecorder(Simulation& simulation, std::string run);
  DurationRecorder(const DurationRecorder&) = delete;
  DurationRecorder& operator=(const DurationRecorder&) = delete;

  const DurationRecord& record() const { return record_; }

 private:
  DurationRecord record_;
  std::map<std::uint64_t, std::uint32_t> places_;  // index in `tasks`, by task id
};

/// Replays the durations of a record of this run; both must outlive the run. If the record ends early, or has another
/// task's duration next, the run fails with BadInput.
class DurationReplay : private kernel::Durations {
 public:
  /// Throws BadInput if the record, read from `file`, belongs to another run than `run`.
  DurationReplay(Simulation& simulation, const DurationRecord& record, const std::string& run, std::string file);
  DurationReplay(const DurationReplay&) = delete;
  DurationReplay& operator=(const DurationReplay&) = delete;

  /// Throws BadInput if durations are left: for a run that ended by itself.
  void check_used_up() const;

 private:
  Duration next(const kernel::Task& task);

  const DurationRecord& record_;
  std::string file_;
  std::size_t next_ = 0;
};

}  // namespace waitpoint
