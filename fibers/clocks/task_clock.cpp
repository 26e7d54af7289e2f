// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/clocks/task_clock.hpp"

#include <ctime>

#include "fibers/kernel/turn.hpp"

namespace waitpoint::kernel {
namespace {

std::int64_t read_ns(clockid_t id) {
  timespec now{};
  clock_gettime(id, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

std::int64_t read_source(ClockKind kind) {
  switch (kind) {
    case ClockKind::proportional: return read_ns(CLOCK_MONOTONIC);
    case ClockKind::cpu: return read_ns(CLOCK_THREAD_CPUTIME_ID);
    case ClockKind::counted: return static_cast<std::int64_t>(turn.blocks);
    default: return 0;
  }
}

// To the nearest nanosecond, halves up.
Duration scaled(Duration d, std::int64_t millionths) {
  const __int128 product = static_cast<__int128>(d.ns()) * millionths + 500'000;
  const __int128 ns = product / 1'000'000;
  WAITPOINT_REQUIRE(ns <= Duration::max().ns(), "virtual time overflows");
  return Duration::from_ns(static_cast<std::int64_t>(ns));
}

void begin_reading(LocalClock& clock, Task&) {
  auto& self = static_cast<TaskClock&>(clock);
  self.runs = true;
  self.started = read_source(self.options.kind);
}

void end_reading(LocalClock& clock, Task& task) {
  auto& self = static_cast<TaskClock&>(clock);
  if (!self.runs) return;
  self.runs = false;
  const std::int64_t passed = read_source(self.options.kind) - self.started;
  const std::int64_t unit_ns = self.options.kind == ClockKind::counted ? self.options.block_cost.ns() : 1;
  const Duration cost = scaled(Duration::from_ns(unit_ns) * passed, self.options.scale_millionths);
  consume(task, filter_cost(task, cost));
}

void compute_as_declared(LocalClock& clock, Task& task, Duration least, Duration greatest) {
  const ClockOptions& options = static_cast<TaskClock&>(clock).options;
  const bool own = options.kind == ClockKind::interval && options.greatest > Duration();
  const Duration cost = own ? choose_cost(task, options.least, options.greatest) : choose_cost(task, least, greatest);
  consume(task, scaled(cost, options.scale_millionths));
}

}  // namespace

TaskClock::TaskClock(const ClockOptions& given) : options(given) {
  WAITPOINT_REQUIRE(options.scale_millionths >= 0, "a local clock is scaled by a negative factor");
  WAITPOINT_REQUIRE(options.least >= Duration() && options.block_cost >= Duration(), "a computing time is negative");
  WAITPOINT_REQUIRE(options.least <= options.greatest, "the ends of an interval of computing times are swapped");
  if (options.kind == ClockKind::fixed || options.kind == ClockKind::interval) {
    compute = compute_as_declared;
  } else {
    begin = begin_reading;
    end = end_reading;
  }
}

}  // namespace waitpoint::kernel
