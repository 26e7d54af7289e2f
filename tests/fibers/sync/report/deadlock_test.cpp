// SPDX-License-Identifier: BSD-3-Clause
// Deadlocks are found at once; the report names tasks, objects and source lines.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "fibers/kernel/call_stack.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/report/source_lines.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

int times(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

// True if addr2line is installed and this program has debugging information.
bool source_lines_can_be_had() {
  std::vector<sync::ReturnAddresses> stacks(1, sync::ReturnAddresses(4));
  stacks[0].resize(kernel::capture_call_stack(stacks[0].data(), stacks[0].size()));
  const auto lines = sync::user_source_lines(stacks, 4);
  for (const std::string& line : lines[0])
    if (contains(line, "deadlock_test.cpp:") && !contains(line, "deadlock_test.cpp:?")) return true;
  return false;
}
std::string place(int line) { return "deadlock_test.cpp:" + std::to_string(line); }

TEST(Deadlock, TwoMutexesInOppositeOrderAreNamedWithTheirTasksAndPlaces) {
  for (std::uint64_t number = 0; number <= 2; ++number) {
    int line_a = 0, line_b = 0;
    const Report report = simulate(
        [&] {
          mutex left("left"), right("right");
          thread a({.name = "anna"}, [&] {
            const std::lock_guard first(left);
            sleep_for(1ms);
            line_a = __LINE__ + 1;
            right.lock();
            right.unlock();
          });
          thread b({.name = "bert"}, [&] {
            const std::lock_guard first(right);
            sleep_for(1ms);
            line_b = __LINE__ + 1;
            left.lock();
            left.unlock();
          });
          a.join();
          b.join();
        },
        order_number(number));
    EXPECT_FALSE(report.passed);
    EXPECT_EQ(report.end, RunEnd::deadlock);
    EXPECT_EQ(report.end_time, Time() + Duration(1ms));
    EXPECT_TRUE(contains(report.text, "deadlock at 0.001000000 s: 2 tasks wait for each other")) << report;
    EXPECT_TRUE(contains(report.text, "task anna of environment waits (lock) for mutex #")) << report;
    EXPECT_TRUE(contains(report.text, "\"right\", held by bert of environment")) << report;
    EXPECT_TRUE(contains(report.text, "task bert of environment waits (lock) for mutex #")) << report;
    EXPECT_TRUE(contains(report.text, "\"left\", held by anna of environment")) << report;
    EXPECT_FALSE(contains(report.text, "task main")) << report;
    if (!source_lines_can_be_had()) continue;
    EXPECT_TRUE(contains(report.text, place(line_a))) << report;
    EXPECT_TRUE(contains(report.text, place(line_b))) << report;
  }
}

TEST(Deadlock, AMutexLockedTwiceByOneTask) {
  const Report report = simulate([] {
    mutex m("twice");
    m.lock();
    m.lock();
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_TRUE(contains(report.text, "a task waits for itself")) << report;
  EXPECT_TRUE(contains(report.text, "task main of environment waits (lock) for mutex #1 \"twice\", held by main"))
      << report;
}

TEST(Deadlock, ThreadsThatJoinEachOther) {
  const Report report = simulate([] {
    thread a, b;
    a = thread({.name = "anna"}, [&] {
      sleep_for(1ms);
      b.join();
    });
    b = thread({.name = "bert"}, [&] {
      sleep_for(1ms);
      a.join();
    });
    sleep_for(2ms);
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_TRUE(contains(report.text, "2 tasks wait for each other")) << report;
  EXPECT_EQ(times(report.text, "waits (join) for end of thread"), 2) << report;
  EXPECT_TRUE(contains(report.text, " of bert of environment")) << report;
}

TEST(Deadlock, AThreadThatJoinsItself) {
  const Report report = simulate([] {
    thread a;
    a = thread([&] { a.join(); });
    sleep_for(1ms);
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_TRUE(contains(report.text, "a task waits for itself")) << report;
}

TEST(Deadlock, ACycleOfFiveThroughMutexesAndAJoin) {
  const Report report = simulate([] {
    std::vector<std::unique_ptr<mutex>> forks;
    for (int i = 0; i < 5; ++i) forks.push_back(std::make_unique<mutex>("fork"));
    std::vector<thread> philosophers;
    for (std::size_t i = 0; i < 4; ++i)
      philosophers.emplace_back([&, i] {
        const std::lock_guard left(*forks[i]);
        sleep_for(1ms);
        const std::lock_guard right(*forks[i + 1]);
      });
    thread last([&] {
      const std::lock_guard left(*forks[4]);
      sleep_for(2ms);
      philosophers[0].join();  // closes the cycle
    });
    sleep_for(1h);
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_EQ(report.end_time, Time() + Duration(2ms));
  EXPECT_TRUE(contains(report.text, "5 tasks wait for each other")) << report;
  EXPECT_EQ(times(report.text, "\n  task "), 5) << report;
  EXPECT_EQ(times(report.text, "waits (lock) for mutex"), 4) << report;
}

TEST(Deadlock, AFiniteTimeoutInTheCycleResolvesIt) {
  in_every_order([] {
    timed_mutex left, right;
    bool gave_up = false;
    thread other([&] {
      const std::lock_guard first(right);
      sleep_for(1ms);
      gave_up = !left.try_lock_for(5ms);
    });
    {
      const std::lock_guard first(left);
      sleep_for(1ms);
      const std::lock_guard second(right);
      EXPECT_EQ(now(), Time() + Duration(6ms));
    }
    other.join();
    EXPECT_TRUE(gave_up);
  });
}

TEST(Deadlock, IsFoundWhereATimeoutLeavesACycleBehind) {
  const Report report = simulate([] {
    timed_mutex left, right;
    thread other([&] {
      const std::lock_guard first(right);
      sleep_for(1ms);
      if (!left.try_lock_for(5ms)) left.lock();
    });
    const std::lock_guard first(left);
    sleep_for(1ms);
    const std::lock_guard second(right);
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_EQ(report.end_time, Time() + Duration(6ms));
  EXPECT_TRUE(contains(report.text, "2 tasks wait for each other")) << report;
}

TEST(Deadlock, UnsignalledCondition) {
  int line = 0;
  const Report report = simulate([&] {
    mutex m;
    condition_variable c("goal reached");
    std::unique_lock lock(m);
    thread other([&] { sleep_for(3ms); });
    line = __LINE__ + 1;
    c.wait(lock);
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_EQ(report.end_time, Time() + Duration(3ms));
  EXPECT_TRUE(contains(report.text, "a task is blocked, and no event can wake it")) << report;
  EXPECT_TRUE(contains(report.text, "task main of environment waits (wait) for condition variable")) << report;
  EXPECT_TRUE(contains(report.text, "\"goal reached\"")) << report;
  EXPECT_TRUE(!source_lines_can_be_had() || contains(report.text, place(line))) << report;
}

// The innermost line shown is the task's wait, then its callers, up to the thread's function; no frames of the library.
TEST(Deadlock, ShowsTheUsersFramesAndOnlyThose) {
  struct Driver {
    static void __attribute__((noinline)) wait_for_ever(counting_semaphore<>& s) {
      s.acquire();
      asm volatile("");
    }
    static void __attribute__((noinline)) run_thread_of_mine(counting_semaphore<>& s) {
      wait_for_ever(s);
      asm volatile("");
    }
  };
  const Report report = simulate([] {
    counting_semaphore<> s(0);
    Driver::run_thread_of_mine(s);
  });
  if (!source_lines_can_be_had()) GTEST_SKIP() << "no addr2line, or no debugging information";
  const std::size_t inner = report.text.find("wait_for_ever"), outer = report.text.find("run_thread_of_mine");
  EXPECT_LT(inner, outer) << report;
  EXPECT_NE(outer, std::string::npos) << report;
  EXPECT_FALSE(contains(report.text, "fibers/sync/simulation")) << report;
  EXPECT_FALSE(contains(report.text, "scheduler.cpp")) << report;
  EXPECT_FALSE(contains(report.text, "semaphore.cpp")) << report;
}

TEST(Deadlock, ManyTasksAreCountedAndTheFirstShown) {
  const Report report = simulate([] {
    counting_semaphore<> never(0);
    for (int i = 0; i < 5000; ++i)
      thread({.name = "waiter", .stack = kernel::StackSize::small}, [&] { never.acquire(); }).detach();
    never.acquire();
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_TRUE(contains(report.text, "5001 tasks are blocked")) << report;
  EXPECT_EQ(times(report.text, "waits (acquire)"), 16);
  EXPECT_TRUE(contains(report.text, "and 4985 more tasks"));
}

TEST(Deadlock, ServicesThatWaitAreNoDeadlock) {
  const Report report = in_order([] {
    static counting_semaphore<> never(0);
    thread({.name = "service", .service = true}, [] { never.acquire(); }).detach();
    sleep_for(1ms);
  });
  EXPECT_EQ(report.end_time, Time() + Duration(1ms));
}

TEST(Deadlock, ServicesAloneCanDeadlock) {
  Simulation simulation;
  mutex m;
  simulation.spawn(simulation.environment(), {.name = "beacon", .service = true}, [&] {
    m.lock();
    m.lock();
  });
  EXPECT_EQ(simulation.run_before(), RunEnd::deadlock);
  EXPECT_TRUE(contains(simulation.trouble(), "a task waits for itself")) << simulation.trouble();
  simulation.unwind();
}

}  // namespace
}  // namespace waitpoint
