// SPDX-License-Identifier: BSD-3-Clause
// Deadlocks through locks that are held recursively, or by several tasks at once. In one order, since resolving the
// source lines of a report is slow.
#include <gtest/gtest.h>

#include <functional>
#include <mutex>
#include <shared_mutex>
#include <string>

#include "fibers/sync/mutex.hpp"
#include "fibers/sync/priority_mutex.hpp"
#include "fibers/sync/recursive_mutex.hpp"
#include "fibers/sync/shared_mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

// Two tasks that each hold one lock and request the other 1 ms later: found at once, with both names.
template <class First, class Second>
void expect_cycle(const std::string& first_kind, const std::string& second_kind) {
  const Report report = simulate([] {
    First left("left");
    Second right("right");
    thread a({.name = "anna"}, [&] {
      left.lock();
      sleep_for(1ms);
      right.lock();
    });
    thread b({.name = "bert"}, [&] {
      right.lock();
      sleep_for(1ms);
      left.lock();
    });
    sleep_for(1h);
  });
  ASSERT_EQ(report.end, RunEnd::deadlock);
  ASSERT_EQ(report.end_time, Time() + Duration(1ms));
  ASSERT_TRUE(contains(report.text, "2 tasks wait for each other")) << report;
  ASSERT_TRUE(contains(report.text, "anna of environment waits (lock) for " + second_kind + " #")) << report;
  ASSERT_TRUE(contains(report.text, "\"right\", held by bert of environment")) << report;
  ASSERT_TRUE(contains(report.text, "bert of environment waits (lock) for " + first_kind + " #")) << report;
  ASSERT_TRUE(contains(report.text, "\"left\", held by anna of environment")) << report;
}

TEST(LockDeadlock, ThroughRecursiveSharedAndPriorityMutexes) {
  expect_cycle<recursive_mutex, recursive_mutex>("recursive mutex", "recursive mutex");
  expect_cycle<shared_timed_mutex, recursive_timed_mutex>("shared mutex", "recursive mutex");
  expect_cycle<priority_mutex, recursive_mutex>("mutex", "recursive mutex");
}

TEST(LockDeadlock, ARecursiveMutexIsNoneForItsOwner) {
  in_every_order([] {
    recursive_mutex m;
    const std::scoped_lock outer(m);
    const std::scoped_lock inner(m);
  });
}

// A writer waits for every reader; one reader that waits for the writer suffices.
TEST(LockDeadlock, WriterAndReaderInACycle) {
  const Report report = simulate([] {
    shared_mutex map("map");
    mutex log("log");
    thread bystander({.name = "bystander"}, [&] {
      const std::shared_lock reads(map);
      sleep_for(1h);
    });
    thread reader({.name = "reader"}, [&] {
      const std::shared_lock reads(map);
      sleep_for(2ms);
      log.lock();
    });
    thread writer({.name = "writer"}, [&] {
      log.lock();
      sleep_for(1ms);
      map.lock();
    });
    sleep_for(1h);
  });
  ASSERT_EQ(report.end, RunEnd::deadlock);
  ASSERT_EQ(report.end_time, Time() + Duration(2ms));
  ASSERT_TRUE(contains(report.text, "writer of environment waits (lock) for shared mutex #")) << report;
  ASSERT_TRUE(contains(report.text, "reader of environment waits (lock) for mutex #")) << report;
}

TEST(LockDeadlock, WaitingForWhatOneHoldsOneself) {
  const auto deadlocks = [](const std::function<void(shared_mutex&)>& body) {
    const Report report = simulate([&] {
      shared_mutex m("own");
      body(m);
    });
    return report.end == RunEnd::deadlock && contains(report.text, "a task waits for itself");
  };
  EXPECT_TRUE(deadlocks([](shared_mutex& m) { m.lock(), m.lock(); }));
  EXPECT_TRUE(deadlocks([](shared_mutex& m) { m.lock(), m.lock_shared(); }));
  EXPECT_TRUE(deadlocks([](shared_mutex& m) { m.lock_shared(), m.lock(); }));
}

// Two readers that both want to write wait for each other to unlock.
TEST(LockDeadlock, TwoReadersUpgradingToWriters) {
  const Report report = simulate([] {
    shared_mutex m("upgraded");
    const auto upgrade = [&] {
      m.lock_shared();
      sleep_for(1ms);
      m.lock();
    };
    thread a(upgrade), b(upgrade);
    sleep_for(1h);
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_EQ(report.end_time, Time() + Duration(1ms));
}

TEST(LockDeadlock, AFiniteTimeoutResolvesIt) {
  in_every_order([] {
    shared_timed_mutex left;
    recursive_timed_mutex right;
    thread other([&] {
      right.lock();
      sleep_for(1ms);
      EXPECT_FALSE(left.try_lock_for(5ms));
      right.unlock();
    });
    left.lock_shared();
    sleep_for(1ms);
    right.lock();
    EXPECT_EQ(now(), Time() + Duration(6ms));
    right.unlock();
    left.unlock_shared();
    other.join();
  });
}

}  // namespace
}  // namespace waitpoint
