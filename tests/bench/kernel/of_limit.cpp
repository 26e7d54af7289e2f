// SPDX-License-Identifier: BSD-3-Clause
// What no kernel of fibers can be faster than: a warm switch of Boost.Context's fcontext alone, and, for tasks that
// sleep, the better of some event sets alone added to it.
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

double switch_ns(int budget_ms) {
  static char stack[0x4000];
  constexpr int round = 10'000;
  context::transfer_t other{context::make_fcontext(stack + sizeof stack, sizeof stack, echo), nullptr};
  std::uint64_t switches = 0;
  const std::int64_t from = clock_ns(Clock::processor);
  std::int64_t spent = 0;
  do {
    for (int i = 0; i < round; ++i) other = context::jump_fcontext(other.fctx, nullptr);
    switches += 2 * round;
    spent = clock_ns(Clock::processor) - from;
  } while (spent < std::int64_t{1'000'000} * budget_ms);
  return static_cast<double>(spent) / static_cast<double>(switches);
}

/// The first tasks in the order of a set; `next` is a fresh start of its own.
template <class Set, class Next>
std::vector<std::uint32_t> first_turns(const Request& request, Next next) {
  const auto tasks = static_cast<std::uint32_t>(request.tasks);
  Set set(tasks, mean_sleep_ns);
  for (std::uint32_t task = 0; task < tasks; ++task) set.insert(next(task), task);
  std::vector<std::uint32_t> turns;
  for (std::uint32_t i = 0; i < 3 * tasks; ++i) {
    const SetEntry least = set.least();
    turns.push_back(least.task);
    set.move_least(least.time + next(least.task));
  }
  return turns;
}

/// Nanoseconds to take the least event out and to put that task's next one in.
template <class Set, class Next>
double turn_ns(const Request& request, Next next) {
  constexpr int round = 20'000;
  const auto tasks = static_cast<std::uint32_t>(request.tasks);
  Set set(tasks, mean_sleep_ns);
  for (std::uint32_t task = 0; task < tasks; ++task) set.insert(next(task), task);
  const auto turns = [&](std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const SetEntry least = set.least();
      set.move_least(least.time + next(least.task));
    }
  };
  turns(2 * tasks);
  std::uint64_t turned = 0;
  const std::int64_t from = clock_ns(Clock::processor);
  std::int64_t spent = 0;
  do {
    turns(round);
    turned += round;
    spent = clock_ns(Clock::processor) - from;
  } while (spent < std::int64_t{1'000'000} * request.budget_ms || turned < tasks);
  return static_cast<double>(spent) / static_cast<double>(turned);
}

template <class Next>
double best_set_ns(const Request& request, Next next) {
  if (first_turns<HeapSet>(request, next) != first_turns<CalendarSet>(request, next)) {
    std::fprintf(stderr, "the event sets disagree on the order\n");
    std::exit(1);
  }
  return std::min(turn_ns<HeapSet>(request, next), turn_ns<CalendarSet>(request, next));
}

double set_ns(const Request& request) {
  const int n = request.tasks;
  std::vector<std::int64_t> periods;
  for (int i = 0; i < n; ++i)
    periods.push_back(request.workload == "harmonic" ? harmonic_period_ns(i) : period_ns(i, n));
  if (request.workload == "periods" || request.workload == "harmonic")
    return best_set_ns(request, [periods](std::uint32_t task) { return periods[task]; });
  const Increments increments(request.workload);
  std::vector<std::size_t> places;
  for (int i = 0; i < n; ++i) places.push_back(increments.start(i));
  return best_set_ns(request,
                     [&increments, places](std::uint32_t task) mutable { return increments.next(places[task]); });
}

void run(const Request& request) {
  const std::string& workload = request.workload;
  if (workload == "timeouts" || workload == "mutex" || workload == "buffer" || workload == "free mutex" ||
      workload == "parked")
    decline();
  double ns = switch_ns(request.budget_ms);
  if (workload != "handover") ns += set_ns(request);
  answer("ns", ns);
  leave();
}

}  // namespace
}  // namespace waitpoint::bench

int main(int argc, char** argv) { waitpoint::bench::run(waitpoint::bench::parse_request(argc, argv)); }
