// SPDX-License-Identifier: BSD-3-Clause
// The interface of one measuring process: its request, measurement and answer.
//
// A process measures one workload once: it creates the tasks, lets them warm up, and counts events until its time
// budget is used up. It prints lines "NAME VALUE" on stdout and leaves by _exit, without teardown.
//
// C++17: Debian's SystemC is built for it, and does not link with later standards.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace waitpoint::bench {

struct Request {
  std::string workload;
  int tasks = 0;
  int budget_ms = 0;
  bool hooks = false;  ///< with a watch on the kernel, if there is one
};

/// From `PROGRAM WORKLOAD TASKS BUDGET_MS [hooks]`.
Request parse_request(int argc, char** argv);

/// Wake-ups, hand-overs, items so far. Written by one thread at a time; read by any.
extern std::atomic<std::uint64_t> counted;
inline std::uint64_t events() { return counted.load(std::memory_order_relaxed); }
inline void count(std::uint64_t more = 1) { counted.store(events() + more, std::memory_order_relaxed); }

/// The measured time: of the processor, which other programs do not disturb, or the wall clock where threads hand over.
enum class Clock { processor, wall };
std::int64_t clock_ns(Clock clock);

/// Writes "NAME VALUE".
void answer(const char* name, double value);
void answer(const char* name, const char* value);

[[noreturn]] void leave();
/// For workloads that this program does not implement.
[[noreturn]] void decline();
constexpr int declined = 77;  ///< its exit status

/// Bytes of this process: resident in total, and in page tables.
std::int64_t resident_bytes();
std::int64_t page_table_bytes();

/// Measures from a task that has started the others: `sleep` lets them run for a span of virtual time with some
/// thousands of events. Answers "ns", the time per event. Warms up first with `warm_events` per task on average.
template <class Sleep>
void measure(const Request& request, Clock clock, Sleep sleep, std::uint64_t warm_events = 2) {
  constexpr std::int64_t warm_ns = 20'000'000;
  const auto tasks = static_cast<std::uint64_t>(request.tasks);
  const std::int64_t begun = clock_ns(clock);
  do sleep();
  while (events() < warm_events * tasks || clock_ns(clock) - begun < warm_ns);

  const std::int64_t budget_ns = std::int64_t{1'000'000} * request.budget_ms;
  const std::uint64_t events_before = events();
  const std::int64_t from = clock_ns(clock);
  std::int64_t spent = 0;
  do {
    sleep();
    spent = clock_ns(clock) - from;
  } while (spent < budget_ns || events() - events_before < tasks);
  answer("ns", static_cast<double>(spent) / static_cast<double>(events() - events_before));
}

}  // namespace waitpoint::bench
