// SPDX-License-Identifier: BSD-3-Clause
// The paper's Algorithms 1 and 2 written down a second time, as plainly as possible: no fibers, no heap, an event list
// that is a sorted vector, and tasks that are interpreted. What a program does here, it must do on the scheduler.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace waitpoint::reference {

enum class Kind : std::uint8_t {
  compute,
  sleep,
  yield,
  lock,
  lock_for,  ///< goes on at `otherwise` if the time runs out
  unlock,
  acquire,
  acquire_for,
  release,
  wait_for,  ///< on condition `object`, with mutex `mutex` held
  notify_one,
  notify_all,
};

/// One step of a task.
struct Step {
  Kind kind = Kind::compute;
  std::size_t object = 0;
  std::int64_t span_ns = 0;
  std::size_t mutex = 0;
  std::size_t otherwise = 0;
};

inline constexpr std::size_t objects_of_a_kind = 3;

using Program = std::vector<std::vector<Step>>;  // steps of each task

/// A step done: by whom, when, and for timed ones whether in time.
struct Done {
  std::size_t task = 0;
  std::size_t step = 0;
  std::int64_t time_ns = 0;
  bool in_time = true;
  friend auto operator<=>(const Done&, const Done&) = default;
};

struct Outcome {
  std::vector<Done> done;
  bool ended = false;  ///< all tasks; else the rest waits for ever
  std::int64_t end_ns = 0;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};

/// A program of `tasks` tasks with about `steps` steps each. Its durations are few, so that events tie often.
Program random_program(std::uint64_t seed, std::size_t tasks, std::size_t steps);

/// What the program does in first-in-first-out order, by the book.
Outcome run_by_the_book(const Program& program);

}  // namespace waitpoint::reference
