// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/local_clock.hpp"

#include "fibers/kernel/processor.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"

namespace waitpoint::kernel {

void set_clock(Task& task, LocalClock* clock) {
  task.clock = clock;
  task.attention = static_cast<std::uint8_t>(clock != nullptr ? task.attention | attention::clock
                                                              : task.attention & ~attention::clock);
}

Time local_time_by_clock(Task& task) {
  if (is_unwinding(*task.scheduler)) return task.local_time;
  LocalClock* clock = task.clock;
  if (clock != nullptr && clock->end != nullptr) {
    clock->end(*clock, task);
    if (clock->begin != nullptr) clock->begin(*clock, task);
  }
  return task.local_time;
}

void consume(Task& task, Duration cost) {
  if (task.seat != nullptr) {
    use_processor(task, cost);
  } else {
    turn.close();
    task.local_time += cost;
  }
}

void access_hardware(Task& task, Duration latency) {
  WAITPOINT_REQUIRE(latency >= Duration(), "an access to hardware has a negative latency");
  if (latency == Duration() || is_unwinding(*task.scheduler)) return;
  const Time after = local_time(task) + latency;
  if (task.seat != nullptr) {
    sleep_until(*task.scheduler, after);  // others use the processor meanwhile
  } else {
    turn.close();
    task.local_time = after;
  }
}

void compute(Task& task, Duration least, Duration greatest) {
  WAITPOINT_REQUIRE(least >= Duration(), "a computing time is negative");
  WAITPOINT_REQUIRE(least <= greatest, "the ends of an interval of computing times are swapped");
  if (is_unwinding(*task.scheduler)) return;
  if (task.clock == nullptr)
    consume(task, choose_cost(task, least, greatest));
  else if (task.clock->compute != nullptr)
    task.clock->compute(*task.clock, task, least, greatest);
}

Duration choose_cost(Task& task, Duration least, Duration greatest) {
  if (least == greatest) return least;
  return filter_cost(task, chooser(*task.scheduler).computing(task, least, greatest));
}

Duration filter_cost(const Task& task, Duration cost) {
  Durations* const durations = hooks(*task.scheduler).durations;
  return durations != nullptr ? durations->pass(*durations, task, cost) : cost;
}

}  // namespace waitpoint::kernel
