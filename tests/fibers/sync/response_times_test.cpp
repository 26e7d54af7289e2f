// SPDX-License-Identifier: BSD-3-Clause
// Simulated response times against response-time analysis, for random sets of periodic tasks on one processor.
//
//   R = C + B + sum over more urgent j of ceil(R / T_j) C_j      (Joseph, Pandya 1986; Sha, Rajkumar, Lehoczky 1990)
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/random.hpp"
#include "fibers/sync/priority_mutex.hpp"
#include "fibers/sync/threads.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

constexpr int resources = 3;

struct PeriodicTask {
  std::int64_t period_us = 0;
  std::int64_t before_us = 0, inside_us = 0, after_us = 0;  // the parts of its cost: inside holds the resource
  int resource = -1;                                        // none
  int priority = 0;

  std::int64_t cost_us() const { return before_us + inside_us + after_us; }
};

using TaskSet = std::vector<PeriodicTask>;  // the most urgent first

// Two to six tasks of 60 to 90 % load altogether; their priorities do not follow their periods.
TaskSet random_set(std::uint64_t number, bool with_resources) {
  const RandomStream random(number, "", "task sets");
  std::uint64_t drawn = 0;
  const auto draw = [&](std::int64_t least, std::int64_t greatest) {
    return least + static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(greatest - least + 1), drawn++));
  };
  TaskSet tasks(static_cast<std::size_t>(draw(2, 6)));
  const std::int64_t load_percent = draw(60, 90);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    PeriodicTask& task = tasks[i];
    task.priority = static_cast<int>(tasks.size() - i);
    task.period_us = draw(500, 10'000);
    const std::int64_t cost = task.period_us * load_percent * draw(50, 150) / 10'000 / std::ssize(tasks) + 1;
    task.before_us = cost;
    if (!with_resources || draw(0, 3) == 0) continue;
    task.resource = static_cast<int>(draw(0, resources - 1));
    task.inside_us = draw(1, cost);
    task.before_us = draw(0, cost - task.inside_us);
    task.after_us = cost - task.inside_us - task.before_us;
  }
  return tasks;
}

// The blocking of task `i` by less urgent tasks.
std::int64_t blocking_us(const TaskSet& tasks, std::size_t i, kernel::LockProtocol protocol) {
  std::int64_t longest_of[resources] = {}, longest = 0, sum_of_tasks = 0;
  for (std::size_t low = i + 1; low < tasks.size(); ++low) {
    const PeriodicTask& task = tasks[low];
    const auto uses_it = [&](const PeriodicTask& t) { return t.resource == task.resource; };
    const auto end = tasks.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    if (task.resource < 0 || std::none_of(tasks.begin(), end, uses_it)) continue;
    auto& of_resource = longest_of[task.resource];
    of_resource = std::max(of_resource, task.inside_us);
    longest = std::max(longest, task.inside_us);
    sum_of_tasks += task.inside_us;
  }
  if (protocol == kernel::LockProtocol::ceiling) return longest;
  std::int64_t sum_of_resources = 0;
  for (const std::int64_t of_resource : longest_of) sum_of_resources += of_resource;
  return std::min(sum_of_tasks, sum_of_resources);
}

// The response time; nothing if it may exceed the period, which is the deadline.
std::optional<std::int64_t> response_us(const TaskSet& tasks, std::size_t i, std::int64_t blocking) {
  for (std::int64_t response = tasks[i].cost_us() + blocking;;) {
    if (response > tasks[i].period_us) return std::nullopt;
    std::int64_t next = tasks[i].cost_us() + blocking;
    for (std::size_t high = 0; high < i; ++high)
      next += (response + tasks[high].period_us - 1) / tasks[high].period_us * tasks[high].cost_us();
    if (next == response) return response;
    response = next;
  }
}

// The worst response time of each task, with first jobs released together at 0 and the others at multiples of the
// periods.
std::vector<std::int64_t> simulated_us(const TaskSet& tasks, std::int64_t until_us, const SimulationOptions& options,
                                       std::optional<kernel::LockProtocol> protocol) {
  std::vector<std::int64_t> worst(tasks.size());
  const Report report = simulate(
      [&] {
        processor cpu;
        std::vector<std::unique_ptr<priority_mutex>> mutexes;
        for (int r = 0; r < resources && protocol; ++r) {
          int ceiling = 0;
          for (const PeriodicTask& task : tasks)
            if (task.resource == r) ceiling = std::max(ceiling, task.priority);
          mutexes.push_back(std::make_unique<priority_mutex>(mutex_attributes{*protocol, ceiling}));
        }
        std::vector<thread> threads;
        for (std::size_t i = 0; i < tasks.size(); ++i)
          threads.emplace_back(thread_attributes{.on = &cpu, .priority = tasks[i].priority}, [&, i] {
            const PeriodicTask& task = tasks[i];
            for (std::int64_t release = 0; release < until_us; release += task.period_us) {
              this_thread::sleep_until(Time::from_ns(release * 1000));
              compute(Duration::from_ns(task.before_us * 1000));
              if (task.resource >= 0) {
                const std::lock_guard guard(*mutexes[static_cast<std::size_t>(task.resource)]);
                compute(Duration::from_ns(task.inside_us * 1000));
              }
              compute(Duration::from_ns(task.after_us * 1000));
              worst[i] = std::max(worst[i], now().ns() / 1000 - release);
            }
          });
        for (thread& t : threads) t.join();
      },
      options);
  EXPECT_TRUE(report.passed) << report;
  return worst;
}

constexpr int sets = 100;
constexpr std::int64_t until_us = 200'000;

TEST(ResponseTimes, EqualTheAnalysisWithoutBlocking) {
  int tried = 0, rejected = 0;
  for (std::uint64_t number = 0; tried < sets; ++number) {
    const TaskSet tasks = random_set(number, false);
    std::vector<std::int64_t> expected;
    for (std::size_t i = 0; i < tasks.size(); ++i)
      if (const auto response = response_us(tasks, i, 0)) expected.push_back(*response);
    if (expected.size() < tasks.size()) {
      ++rejected;
      continue;
    }
    ++tried;
    EXPECT_EQ(simulated_us(tasks, until_us, order_number(number % 3), std::nullopt), expected) << "set " << number;
  }
  EXPECT_GT(rejected, 0);  // some sets are infeasible
}

TEST(ResponseTimes, KeepTheBoundsOfInheritanceAndCeiling) {
  for (const auto protocol : {kernel::LockProtocol::inherit, kernel::LockProtocol::ceiling}) {
    int tried = 0;
    std::size_t blocked = 0, at_bound = 0;
    for (std::uint64_t number = 1000; tried < sets; ++number) {
      const TaskSet tasks = random_set(number, true);
      std::vector<std::int64_t> bound, without;
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        const auto response = response_us(tasks, i, blocking_us(tasks, i, protocol));
        if (!response) break;
        bound.push_back(*response);
        without.push_back(*response_us(tasks, i, 0));
      }
      if (bound.size() < tasks.size()) continue;
      ++tried;
      const auto simulated = simulated_us(tasks, until_us, order_number(number % 3), protocol);
      for (std::size_t i = 0; i < tasks.size(); ++i) {
        EXPECT_LE(simulated[i], bound[i]) << "task " << i << " of set " << number;
        EXPECT_GE(simulated[i], tasks[i].cost_us());
        blocked += simulated[i] > without[i];
        at_bound += simulated[i] == bound[i];
      }
    }
    EXPECT_GT(blocked, 20u);   // blocking occurs
    EXPECT_GT(at_bound, 50u);  // and the bounds are tight
  }
}

}  // namespace
}  // namespace waitpoint
