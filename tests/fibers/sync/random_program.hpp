// SPDX-License-Identifier: BSD-3-Clause
// Random programs of tasks and primitives, as data, which both the scheduler and the reference model execute.
#pragma once

#include <cstdint>
#include <vector>

namespace waitpoint::reference {

enum class Kind : std::uint8_t {
  compute,
  sleep,
  yield,
  lock,
  lock_for,  ///< continues at `otherwise` after a timeout
  unlock,
  acquire,
  acquire_for,
  release,
  wait_for,  ///< on condition `object`, with mutex `mutex` held
  notify_one,
  notify_all,
  tick,    ///< the next tick of the task's own timer
  spawn,   ///< task `object`
  join,    ///< task `object`
  detach,  ///< task `object`
};

/// One step of a task.
struct Step {
  Kind kind = Kind::compute;
  std::size_t object = 0;
  std::int64_t span_ns = 0;
  std::size_t mutex = 0;
  std::size_t otherwise = 0;
};

struct Program {
  std::vector<std::vector<Step>> tasks;  ///< the steps of each
  std::vector<std::int64_t> periods_ns;  ///< of each task's timer
  std::size_t roots = 0;                 ///< the first tasks start with the run; each other one is spawned once
  std::size_t objects = 0;               ///< of each kind
};

/// A program of `tasks` tasks with about `steps` steps each. It has few different durations, so that events tie often.
Program random_program(std::uint64_t seed, std::size_t tasks, std::size_t steps);

}  // namespace waitpoint::reference
