// SPDX-License-Identifier: BSD-3-Clause
// The durations of a run that do not follow from its scenario and seed: what local clocks measured, counted or chose.
//
// They are written down in the order in which they began to count. The run that gets them back in that order is the
// same run, whatever the machine measures then. As text:
//
//   waitpoint durations 1
//   run 5f0d97a1c0ffee42 seed 7         which scenario, with what was set, and which seed
//   task 1 8c0d2f0a9b3e4f55 r0.motion   the first duration of each task says its name before
//   1 15322                             of task 1: 15 322 ns
//   1 900
//   end 2                               how many there were; a record without its last line ends early
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
    std::uint32_t task = 0;  ///< its place in `tasks`
    std::int64_t ns = 0;
    friend bool operator==(const Entry&, const Entry&) = default;
  };
  std::string run;  ///< what the record belongs to, in one line
  std::vector<TaskName> tasks;
  std::vector<Entry> entries;

  friend bool operator==(const DurationRecord&, const DurationRecord&) = default;
};

std::string to_text(const DurationRecord& record);

/// Throws BadInput, naming `file` and the line, for what is no record, or one that ends early.
DurationRecord parse_duration_record(const std::string& file, std::string_view text);

/// Writes down the durations of a run; must outlive it.
class DurationRecorder : private kernel::Durations {
 public:
  DurationRecorder(Simulation& simulation, std::string run);
  DurationRecorder(const DurationRecorder&) = delete;
  DurationRecorder& operator=(const DurationRecorder&) = delete;

  const DurationRecord& record() const { return record_; }

 private:
  DurationRecord record_;
  std::map<std::uint64_t, std::uint32_t> places_;  // of tasks, by their ids
};

/// Gives a run the durations of a record, which belongs to it; both must outlive the run. If the record ends before the
/// run does, or is another task's, the run fails with BadInput.
class DurationReplay : private kernel::Durations {
 public:
  /// Throws BadInput if the record, read from `file`, does not belong to `run`.
  DurationReplay(Simulation& simulation, const DurationRecord& record, const std::string& run, std::string file);
  DurationReplay(const DurationReplay&) = delete;
  DurationReplay& operator=(const DurationReplay&) = delete;

  /// Throws BadInput if durations are left: for a run that is over by itself.
  void check_used_up() const;

 private:
  Duration next(const kernel::Task& task);

  const DurationRecord& record_;
  std::string file_;
  std::size_t next_ = 0;
};

}  // namespace waitpoint
