// SPDX-License-Identifier: BSD-3-Clause
// What one measuring process is asked, how it measures, and what it answers.
//
// A process measures one workload once: it builds the tasks, lets them warm up, and then counts events until its budget
// of time is used up. It answers in lines "NAME VALUE" on stdout and leaves by _exit: nothing is taken down.
//
// C++17: Debian's SystemC is built for it, and links with nothing newer.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

namespace waitpoint::bench {

struct Request {
  std::string workload;
  int tasks = 0;
  int budget_ms = 0;
  bool hooks = false;  ///< with a watch on the kernel, where there is one
};

/// From `PROGRAM WORKLOAD TASKS BUDGET_MS [hooks]`.
Request parse_request(int argc, char** argv);

/// Wake-ups, hand-overs, items so far. Only one thread at a time counts them up; another may look.
extern std::atomic<std::uint64_t> counted;
inline std::uint64_t events() { return counted.load(std::memory_order_relaxed); }
inline void count(std::uint64_t more = 1) { counted.store(events() + more, std::memory_order_relaxed); }

/// Which time counts: of the processor, which other programs do not disturb, or, where threads hand over, of the wall.
enum class Clock { processor, wall };
std::int64_t clock_ns(Clock clock);

/// Writes "NAME VALUE".
void answer(const char* name, double value);
void answer(const char* name, const char* value);

[[noreturn]] void leave();
/// For a workload that this program does not have.
[[noreturn]] void decline();
constexpr int declined = 77;  ///< its exit status

/// Bytes of this process: resident in all, and in page tables.
std::int64_t resident_bytes();
std::int64_t page_table_bytes();

/// Measures from within a task that has begun the others: `sleep` lets them go on for a stretch of virtual time that
/// holds some thousands of events. Answers "ns", the time an event. Before, each task has `warm_events` on average.
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
