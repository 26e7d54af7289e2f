// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fibers/explore/feasibility.hpp"

#include <z3++.h>

#include <map>
#include <string>

namespace waitpoint::timed {
namespace {

struct Interval {
  std::int64_t least = 0, greatest = 0;
};

// The computing time of `task` between its events number `sequence` - 1 and `sequence`.
Interval between(const std::vector<Spent>& spent, std::uint64_t task, std::uint64_t sequence) {
  Interval sum;
  for (const Spent& one : spent)
    if (one.task == task && one.after == sequence) {
      sum.least += one.least_us;
      sum.greatest += one.greatest_us;
    }
  return sum;
}

}  // namespace

bool is_feasible(const Trace& trace) {
  z3::context context;
  z3::solver solver(context);
  std::vector<z3::expr> dates;
  std::map<std::uint64_t, std::size_t> first_of_task, last_of_task, last_at_object;
  const auto add = [&](const TracedEvent& event) {
    const z3::expr date = context.real_const(("t" + std::to_string(dates.size())).c_str());
    const auto before = last_of_task.find(event.task);
    const auto at_object = last_at_object.find(event.object);
    if (event.was_woken && at_object != last_at_object.end()) {
      solver.add(date == dates[at_object->second]);
    } else if (before != last_of_task.end()) {
      const Interval cost = between(trace.spent, event.task, event.sequence);
      solver.add(date - dates[before->second] >= context.real_val(cost.least));
      solver.add(date - dates[before->second] <= context.real_val(cost.greatest));
    } else if (const auto maker = first_of_task.find(event.maker); maker != first_of_task.end()) {
      solver.add(date == dates[maker->second]);
    }
    dates.push_back(date);
  };
  for (const TracedEvent& event : trace.events) {
    add(event);
    const std::size_t at = dates.size() - 1;
    solver.add(at == 0 ? dates[0] == 0 : dates[at] >= dates[at - 1]);
    first_of_task.emplace(event.task, at);
    last_of_task[event.task] = at;
    if (event.object != 0) last_at_object[event.object] = at;
  }
  const std::size_t last = dates.size() - 1;
  for (const TracedEvent& event : trace.pending) {
    add(event);
    solver.add(dates.back() >= dates[last]);
  }
  return solver.check() == z3::sat;
}

}  // namespace waitpoint::timed
