// SPDX-License-Identifier: BSD-3-Clause
// A lower bound for any kernel of fibers: a warm switch of Boost.Context's fcontext alone, and, for sleeping tasks,
// plus the better of several event sets alone.
#include <algorithm>
#include <boost/context/detail/fcontext.hpp>
#include <cstdio>
#include <cstdlib>

#include "tests/bench/kernel/event_sets.hpp"
#include "tests/bench/kernel/increments.hpp"
#include "tests/bench/kernel/meter.hpp"

namespace waitpoint::bench {
namespace {

namespace context = boost::context::detail;

void echo(context::transfer_t from) {
  for (;;) from = context::jump_fcontext(from.fctx, nullptr);
}

/// The mean over the budget of `round`, which executes some operations and returns their number; at least `least` of
/// them.
template <class Round>
double mean_ns(int budget_ms, std::uint64_t least, Round round) {
  std::uint64_t done = 0;
  const std::int64_t from = clock_ns(Clock::processor);
  std::int64_t spent = 0;
  do {
    done += round();
    spent = clock_ns(Clock::processor) - from;
  } while (spent < std::int64_t{1'000'000} * budget_ms || done < least);
  return static_cast<double>(spent) / static_cast<double>(done);
}

double switch_ns(int budget_ms) {
  static char stack[0x4000];
  context::transfer_t other{context::make_fcontext(stack + sizeof stack, sizeof stack, echo), nullptr};
  return mean_ns(budget_ms, 0, [&] {
    constexpr int times = 10'000;
    for (int i = 0; i < times; ++i) other = context::jump_fcontext(other.fctx, nullptr);
    return 2 * times;  // there and back
  });
}

/// The sleeps of tasks; a copy continues from the original's position.
struct Periods {
  explicit Periods(const Request& request) {
    for (int i = 0; i < request.tasks; ++i) of.push_back(period_ns(request.workload, i, request.tasks));
  }
  std::int64_t first(std::uint32_t task) const { return of[task]; }
  std::int64_t next(std::uint32_t task) const { return of[task]; }
  std::int64_t mean() const { return mean_sleep_ns; }
  std::vector<std::int64_t> of;
};
struct Draws {
  explicit Draws(const Request& request) : increments(request.workload), at(static_cast<std::size_t>(request.tasks)) {}
  std::int64_t first(std::uint32_t task) { return increments.first(static_cast<int>(task), at[task]); }
  std::int64_t next(std::uint32_t task) { return increments.next(at[task]); }
  std::int64_t mean() const { return increments.mean_ns(); }
  Increments increments;
  std::vector<std::size_t> at;
};

/// A set and its tasks.
template <class Set, class Sleeps>
struct Turning {
  explicit Turning(Sleeps of) : sleeps(std::move(of)), tasks(count_of(sleeps)), set(tasks, sleeps.mean()) {
    for (std::uint32_t task = 0; task < tasks; ++task) set.insert(sleeps.first(task), task);
  }
  static std::uint32_t count_of(const Periods& periods) { return static_cast<std::uint32_t>(periods.of.size()); }
  static std::uint32_t count_of(const Draws& draws) { return static_cast<std::uint32_t>(draws.at.size()); }

  /// Takes the least event out and inserts that task's next one.
  std::uint32_t turn() {
    const SetEntry least = set.least();
    set.move_least(least.time + sleeps.next(least.task));
    return least.task;
  }
  double turn_ns(int budget_ms) {
    for (std::uint32_t i = 0; i < 2 * tasks; ++i) turn();
    return mean_ns(budget_ms, tasks, [this] {
      constexpr int times = 20'000;
      for (int i = 0; i < times; ++i) turn();
      return times;
    });
  }

  Sleeps sleeps;
  std::uint32_t tasks;
  Set set;
};

template <class Sleeps>
double best_set_ns(const Request& request) {
  const Sleeps sleeps(request);
  Turning<HeapSet, Sleeps> heap(sleeps);
  Turning<CalendarSet, Sleeps> calendar(sleeps);
  for (std::uint32_t i = 0; i < 3 * heap.tasks; ++i)
    if (heap.turn() != calendar.turn()) {
      std::fprintf(stderr, "the event sets disagree on the order\n");
      std::exit(1);
    }
  return std::min(heap.turn_ns(request.budget_ms), calendar.turn_ns(request.budget_ms));
}

void run(const Request& request) {
  const std::string& workload = request.workload;
  if (workload != "handover" && !is_of_sleepers(workload)) decline();
  double ns = switch_ns(request.budget_ms);
  if (is_of_periods(workload))
    ns += best_set_ns<Periods>(request);
  else if (workload != "handover")
    ns += best_set_ns<Draws>(request);
  answer("ns", ns);
  leave();
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { waitpoint::bench::run(waitpoint::bench::parse_request(argc, argv)); }
