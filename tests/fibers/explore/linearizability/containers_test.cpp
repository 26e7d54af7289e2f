// SPDX-License-Identifier: BSD-3-Clause
// Histories of containers in explored schedules.
#include <gtest/gtest.h>

#include <vector>

#include "fibers/explore/explore.hpp"
#include "fibers/explore/linearizable.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/explore/linearizability/containers.hpp"
#include "tests/fibers/explore/linearizability/models.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using models::Fifo, models::MapByKeys, models::Register, models::Stack;

// One task for each function; the history must be linearizable.
template <class Model, class... Functions>
void check_together(const History<Model>& history, Functions... functions) {
  {
    std::vector<thread> tasks;
    (tasks.emplace_back(functions), ...);
    for (thread& task : tasks) task.join();
  }
  check(linearizable(history, Model()));
}

// Two producers with two elements each, and a consumer.
template <class Model, class Container>
void push_and_pop() {
  Container container;
  History<Model> history;
  const auto push = [&](int value) { history.record({"push", value}, [&] { container.push(value); }); };
  check_together(
      history, [&] { push(1), push(3); }, [&] { push(2); },
      [&] {
        for (int i = 0; i < 3; ++i) history.record({"pop"}, [&] { return container.pop(); });
      },
      [&] { history.record({"pop"}, [&] { return container.pop(); }); });
}

TEST(LinearizableContainers, ACorrectQueuePassesInAllSchedules) {
  const ExploreReport report = explore(push_and_pop<Fifo, containers::Queue>, {.iterations = 3000});
  EXPECT_TRUE(report.passed) << report;
  EXPECT_FALSE(explore(push_and_pop<Stack, containers::Queue>).passed);  // it is no stack
}

void expect_not_linearizable(void (*body)(), const std::string& operation) {
  const ExploreReport report = explore(body);
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, ": not linearizable\n")) << report;
  EXPECT_TRUE(contains(report.text, operation)) << report;
  EXPECT_TRUE(contains(report.text, "^ end of the prefix")) << report;
  EXPECT_LE(report.schedule.switches.size(), 3U) << report;
}

TEST(LinearizableContainers, PlantedBugsAreFound) {
  expect_not_linearizable(push_and_pop<Fifo, containers::DoublingQueue>, "no place is left for 'pop -> ");
  expect_not_linearizable(push_and_pop<Fifo, containers::LanedQueue>, "no place is left for 'pop -> ");
  expect_not_linearizable(push_and_pop<Stack, containers::LosingStack>, "no place is left for 'pop -> ");
  const auto read_early = [] {
    containers::LateRegister value;
    History<Register> history;
    check_together(
        history,
        [&] {
          history.record({"write", 1}, [&] { value.write(1); });
        },
        [&] {
          history.record({"read"}, [&] { return value.read(); });
          history.record({"read"}, [&] { return value.read_copy(); });
        });
  };
  expect_not_linearizable(read_early, "no place is left for 'read -> 0'");
  const auto replace = [] {
    containers::GappyMap map;
    History<MapByKeys> history;
    const auto put = [&](int key, int value) { history.record({"put", value, key}, [&] { map.put(key, value); }); };
    put(1, 7);
    check_together(
        history, [&] { put(2, 5), put(1, 8); },
        [&] {
          history.record({"get", 0, 1}, [&] { return map.get(1); });
        });
  };
  expect_not_linearizable(replace, "operations on key 1:\n");
}

TEST(LinearizableContainers, TwoHundredOperationsOfEightTasks) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SimulationOptions options;
    options.order = kernel::Order::seeded;
    options.seed = seed;
    const Report report = simulate(
        [] {
          containers::Queue queue;
          History<Fifo> history;
          std::vector<thread> tasks;
          tasks.reserve(8);
          for (int task = 0; task < 8; ++task)
            tasks.emplace_back([&, task] {
              for (int i = 1; i <= 25; ++i)
                if (i % 2 == 0)
                  history.record({"pop"}, [&] { return queue.pop(); });
                else
                  history.record({"push", 100 * task + i}, [&] { queue.push(100 * task + i); });
            });
          for (thread& task : tasks) task.join();
          check(linearizable(history, Fifo()));
        },
        options);
    EXPECT_TRUE(report.passed) << report;
  }
}

TEST(LinearizableContainers, RecordingChangesNoEvent) {
  const auto run = [](bool records) {
    return simulate([records] {
      containers::Queue queue;
      History<Fifo> history;
      const auto push = [&](int value) {
        if (records)
          history.record({"push", value}, [&] { queue.push(value); });
        else
          queue.push(value);
      };
      thread one([&] { push(1), push(2); }), two([&] { push(3); });
      one.join(), two.join();
      EXPECT_EQ(history.entries().size(), records ? 3U : 0U);
    });
  };
  const Report with = run(true), without = run(false);
  EXPECT_EQ(with.events, without.events);
  EXPECT_EQ(with.digest.value(), without.digest.value());
}

// The bell rings before the consumer listens: its operation stays pending when the run is unwound.
TEST(LinearizableContainers, AfterADeadlockTheBlockedOperationsArePending) {
  History<Fifo> history;
  const Report report = simulate([&] {
    mutex door;
    condition_variable bell;
    history.record({"push", 1}, [&] { bell.notify_one(); });
    thread consumer({.name = "consumer"}, [&] {
      history.record({"pop"}, [&]() -> std::optional<int> {
        std::unique_lock lock(door);
        bell.wait(lock);
        return 1;
      });
    });
    consumer.join();
  });
  EXPECT_FALSE(report.passed);
  ASSERT_EQ(history.entries().size(), 2U);
  EXPECT_FALSE(history.entries()[1].result.has_value());
  EXPECT_EQ(history.entries()[1].task, "consumer#1");
  EXPECT_TRUE(linearizable(history, Fifo()));
}

}  // namespace
}  // namespace waitpoint
