// SPDX-License-Identifier: BSD-3-Clause
// The sentence with the cause of a failure: each pattern in a body that has it, and none in bodies that have another.
#include <gtest/gtest.h>

#include <string>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

// The sentence without "cause: " and the numbers of objects; empty if the report has none.
std::string cause_of(const ExploreReport& report) {
  EXPECT_FALSE(report.passed);
  const std::string line = "\ncause: ";
  const std::size_t begin = report.text.find(line);
  if (begin == std::string::npos) return "";
  const std::size_t from = begin + line.size();
  std::string text = report.text.substr(from, report.text.find('\n', from) - from);
  for (std::size_t at = text.find(" #"); at != std::string::npos; at = text.find(" #", at))
    text.erase(at, text.find_first_not_of("0123456789", at + 2) - at);
  return text;
}

TEST(Cause, IsLocksInOppositeOrders) {
  const ExploreReport report = explore([] {
    mutex left, right;
    thread a({.name = "a"}, [&] { const std::lock_guard first(left), second(right); });
    thread b({.name = "b"}, [&] { const std::lock_guard first(right), second(left); });
    a.join(), b.join();
  });
  EXPECT_EQ(cause_of(report),
            "locks are taken in opposite orders: a holds mutex and waits for mutex, b holds mutex and waits for mutex")
      << report;
}

TEST(Cause, IsALockThatIsHeldAlready) {
  const ExploreReport report = explore([] {
    mutex one;
    const std::lock_guard first(one), second(one);
  });
  EXPECT_EQ(cause_of(report), "main locks mutex, which it holds") << report;
}

// The state is looked at in one critical section, and waited for in another.
void wait_in_two_sections(bool* is_ready, mutex* guard, condition_variable* change) {
  {
    const std::lock_guard lock(*guard);
    if (*is_ready) return;
  }
  std::unique_lock lock(*guard);
  change->wait(lock);
}

TEST(Cause, IsALostWakeUp) {
  const ExploreReport report = explore([] {
    mutex guard;
    condition_variable change;
    bool is_ready = false;
    thread waiter({.name = "waiter"}, [&] { wait_in_two_sections(&is_ready, &guard, &change); });
    thread signaller({.name = "signaller"}, [&] {
      const std::lock_guard lock(guard);
      is_ready = true;
      change.notify_one();
    });
    waiter.join(), signaller.join();
  });
  EXPECT_EQ(
      cause_of(report),
      "lost wake-up: notify_one of signaller comes before waiter waits for condition variable, and no notification "
      "comes after it")
      << report;
}

// The second of two items is not notified, since the first is still there.
TEST(Cause, IsANotificationThatAnotherTaskGets) {
  const ExploreReport report = explore([] {
    mutex guard;
    condition_variable change;
    int items = 0;
    const auto consume = [&] {
      std::unique_lock lock(guard);
      while (items == 0) change.wait(lock);
      --items;
    };
    const auto produce = [&] {
      const std::lock_guard lock(guard);
      if (++items == 1) change.notify_one();
    };
    thread a({.name = "a"}, consume), b({.name = "b"}, consume), c({.name = "c"}, produce), d({.name = "d"}, produce);
    for (thread* each : {&a, &b, &c, &d}) each->join();
  });
  EXPECT_EQ(
      cause_of(report),
      "missed notification: b waits for condition variable, but the only notification since then, notify_one of c, "
      "wakes a")
      << report;
}

TEST(Cause, IsAnUpdateThatIsLost) {
  const ExploreReport report = explore([] {
    atomic<int> sum{0};
    const auto add = [&] { sum.store(sum.load() + 1); };
    thread a({.name = "a"}, add), b({.name = "b"}, add);
    a.join(), b.join();
    check(sum.load() == 2, "an update was lost");
  });
  const std::string cause = cause_of(report);
  EXPECT_TRUE(cause == "lost update: b writes atomic between the read and the write of a" ||
              cause == "lost update: a writes atomic between the read and the write of b")
      << report;
}

TEST(Cause, IsACriticalSectionBetweenTwoOfAnotherTask) {
  const ExploreReport report = explore([] {
    mutex guard;
    int balance = 0;
    const auto add = [&] {
      guard.lock();
      const int seen = balance;
      guard.unlock();
      const std::lock_guard lock(guard);
      balance = seen + 1;
    };
    thread a({.name = "a"}, add), b({.name = "b"}, add);
    a.join(), b.join();
    check(balance == 2, "an update was lost");
  });
  const std::string cause = cause_of(report);
  EXPECT_TRUE(cause == "b locks mutex between two critical sections of a" ||
              cause == "a locks mutex between two critical sections of b")
      << report;
}

TEST(Cause, IsAReadBeforeTheFirstWrite) {
  const ExploreReport report = explore([] {
    atomic<int> value{0};
    thread writer({.name = "writer"}, [&] {
      this_thread::yield();
      value.store(1);
    });
    thread reader({.name = "reader"}, [&] {
      this_thread::yield();
      check(value.load() == 1, "read too early");
    });
    writer.join(), reader.join();
  });
  const std::string cause = cause_of(report), early = "reader reads atomic before ";
  EXPECT_TRUE(cause == early + "writer writes it first" || cause == early + "a task that has not begun writes it first")
      << report;
}

// A barrier that is used again: the last thread of a round may wait for the next before the others have left.
TEST(Cause, IsNoLostWakeUpWhereTheWaiterItselfWasTheLastToNotify) {
  const ExploreReport report = explore([] {
    mutex guard;
    condition_variable change;
    std::unique_lock lock(guard);
    change.notify_all();
    change.wait(lock);
  });
  EXPECT_EQ(cause_of(report), "main waits for condition variable, which no task has notified since it did so itself")
      << report;
}

// What no pattern fits has no sentence.
TEST(Cause, IsNotClaimedOfOtherFailures) {
  EXPECT_EQ(cause_of(explore([] { check(false, "always"); })), "");
  // One task is blocked at a condition, but another waits for what nobody releases.
  EXPECT_EQ(cause_of(explore([] {
              mutex guard;
              condition_variable change;
              counting_semaphore<> never(0);
              thread waiter([&] {
                std::unique_lock lock(guard);
                change.wait(lock);
              });
              thread signaller([&] {
                change.notify_one();
                never.acquire();
              });
              waiter.join(), signaller.join();
            })),
            "");
}

}  // namespace
}  // namespace waitpoint
