// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/condition_variable_any.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <mutex>
#include <new>
#include <set>
#include <shared_mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include "fibers/sync/mutex.hpp"
#include "fibers/sync/recursive_mutex.hpp"
#include "fibers/sync/shared_mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

// A user's own lock with only lock() and unlock(), which lets other tasks run during unlock().
struct LeisurelyLock {
  void lock() { m.lock(), held = true; }
  void unlock() {
    held = false;
    m.unlock();
    this_thread::yield();
  }
  mutex m;
  bool held = false;
};

// A notification between the unlock and the sleep is not lost.
TEST(ConditionVariableAny, NoItemIsLostOverAnyLock) {
  in_every_order([] {
    LeisurelyLock m;
    condition_variable_any changed;
    int items = 0, taken = 0;
    std::vector<thread> threads;
    for (int consumer = 0; consumer < 3; ++consumer)
      threads.emplace_back([&] {
        for (int i = 0; i < 10; ++i) {
          m.lock();
          changed.wait(m, [&] { return items > 0; });
          EXPECT_TRUE(m.held);
          --items, ++taken;
          m.unlock();
        }
      });
    for (int producer = 0; producer < 2; ++producer)
      threads.emplace_back([&] {
        for (int i = 0; i < 15; ++i) {
          if (i % 4 == 0) sleep_for(1ms);
          const std::lock_guard guard(m);
          ++items;
          changed.notify_one();
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(taken, 30);
    EXPECT_EQ(items, 0);
  });
}

TEST(ConditionVariableAny, WaitsWithDifferentLocksAtOnce) {
  in_every_order([] {
    condition_variable_any go;
    recursive_mutex recursive;
    shared_mutex shared;
    timed_mutex timed;
    int woken = 0;
    thread a([&] {
      std::unique_lock lock(recursive);
      go.wait(lock);
      EXPECT_TRUE(lock.owns_lock());
      ++woken;
    });
    thread b([&] {
      std::shared_lock lock(shared);
      EXPECT_EQ(go.wait_for(lock, 1h), cv_status::no_timeout);
      ++woken;
    });
    thread c([&] {
      const std::lock_guard lock(timed);
      EXPECT_EQ(go.wait_until(timed, steady_clock::time_point(1h)), cv_status::no_timeout);
      ++woken;
    });
    sleep_for(5ms);
    // All locks are free while their holders wait.
    EXPECT_TRUE(recursive.try_lock() && shared.try_lock() && timed.try_lock());
    go.notify_all();
    sleep_for(5ms);
    EXPECT_EQ(woken, 0);
    recursive.unlock(), shared.unlock(), timed.unlock();
    for (thread* t : {&a, &b, &c}) t->join();
    EXPECT_EQ(woken, 3);
    EXPECT_EQ(now(), at(10ms));
  });
}

TEST(ConditionVariableAny, NotifyOneWakesTheFirstAndInSeededOrdersAny) {
  std::set<std::string> orders;
  for (std::uint64_t number = 0; number <= 60; ++number) {
    std::string order;
    const Report report = simulate(
        [&] {
          mutex m;
          condition_variable_any c;
          std::vector<thread> threads;
          for (const char name : {'a', 'b', 'c'})
            threads.emplace_back([&, name] {
              sleep_for((name - 'a' + 1) * 1ms);
              std::unique_lock lock(m);
              c.wait(lock);
              order += name;
            });
          for (int i = 0; i < 3; ++i) {
            sleep_for(10ms);
            EXPECT_EQ(order.size(), static_cast<std::size_t>(i));
            c.notify_one();
          }
          for (thread& t : threads) t.join();
          c.notify_one();
          c.notify_all();
        },
        order_number(number));
    ASSERT_TRUE(report.passed) << report;
    if (number == 0) {
      EXPECT_EQ(order, "abc");
    }
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 6u);
}

TEST(ConditionVariableAny, TimesOutAtTheDeadlineHoldingTheLock) {
  in_every_order([] {
    recursive_mutex m;
    condition_variable_any c;
    std::unique_lock lock(m);
    EXPECT_EQ(c.wait_for(lock, 5ms), cv_status::timeout);
    EXPECT_EQ(now(), at(5ms));
    EXPECT_EQ(c.wait_until(lock, steady_clock::time_point(7ms)), cv_status::timeout);
    EXPECT_EQ(c.wait_until(lock, steady_clock::time_point(1ms)), cv_status::timeout);
    EXPECT_EQ(c.wait_for(lock, 0s), cv_status::timeout);
    EXPECT_EQ(c.wait_for(lock, -1h), cv_status::timeout);
    EXPECT_EQ(now(), at(7ms));
    EXPECT_FALSE(c.wait_for(lock, 2ms, [] { return false; }));
    EXPECT_TRUE(c.wait_until(lock, steady_clock::time_point(11ms), [] { return now() >= at(11ms); }));
    EXPECT_EQ(now(), at(11ms));
    thread([&] { EXPECT_FALSE(m.try_lock()); }).join();
    c.notify_all();  // no waiters are left
  });
}

TEST(ConditionVariableAny, NotifiedAtTheInstantOfTheDeadlineNothingIsLost) {
  expect_both([] {
    mutex m;
    condition_variable_any c;
    int woken = 0;
    bool notified = false;
    std::vector<thread> threads;
    for (int i = 0; i < 2; ++i)
      threads.emplace_back([&, i] {
        std::unique_lock lock(m);
        const bool in_time = c.wait_for(lock, i == 0 ? 5ms : 9ms) == cv_status::no_timeout;
        woken += in_time;
        if (i == 0) notified = in_time;
      });
    sleep_for(5ms);
    c.notify_one();
    for (thread& t : threads) t.join();
    EXPECT_EQ(woken, 1);
    return notified;
  });
}

TEST(ConditionVariableAny, MayBeDestroyedAsSoonAsAllAreNotified) {
  in_every_order([] {
    LeisurelyLock m;
    alignas(condition_variable_any) unsigned char memory[sizeof(condition_variable_any)];
    auto* c = new (memory) condition_variable_any;
    std::vector<thread> threads;
    int waiting = 0, woken = 0;
    for (int i = 0; i < 3; ++i)
      threads.emplace_back([&] {
        m.lock();
        ++waiting;
        c->wait(m);
        ++woken;
        m.unlock();
      });
    // At the same instant: some may not sleep yet.
    while (waiting < 3) this_thread::yield();
    m.lock();
    c->notify_all();
    c->~condition_variable_any();
    std::memset(memory, 0xAB, sizeof memory);
    m.unlock();
    for (thread& t : threads) t.join();
    EXPECT_EQ(woken, 3);
    for (const unsigned char byte : memory) ASSERT_EQ(byte, 0xAB);
  });
}

TEST(ConditionVariableAny, AnUnlockThatThrowsEndsTheWait) {
  struct Faulty {
    void lock() {}
    void unlock() { throw std::runtime_error("not today"); }
  } faulty;
  in_order([&] {
    condition_variable_any c;
    EXPECT_THROW(c.wait(faulty), std::runtime_error);
    c.notify_one();
  });
}

TEST(ConditionVariableAny, UnwindingLeavesTheLockHeld) {
  bool held = false;
  {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {}, [&] {
      LeisurelyLock m;
      condition_variable_any c;
      struct Look {
        ~Look() { held = m.held; }
        bool& held;
        LeisurelyLock& m;
      };
      m.lock();
      const Look look{held, m};
      c.wait_for(m, 1h);
      ADD_FAILURE();
    });
    EXPECT_EQ(simulation.run_before(at(1ms)), RunEnd::time_reached);
  }
  EXPECT_TRUE(held);
}

TEST(ConditionVariableAny, StateOfAnotherRunIsForgotten) {
  static condition_variable_any left;
  for (int repeat = 0; repeat < 3; ++repeat) {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {}, [] {
      left.notify_all();
      mutex m;
      std::unique_lock lock(m);
      EXPECT_EQ(left.wait_for(lock, 1us), cv_status::timeout);
      left.wait(lock);
    });
    EXPECT_EQ(simulation.run_before(at(1ms)), RunEnd::deadlock);
  }
}

TEST(ConditionVariableAnyDeathTest, MisuseHasAName) {
  EXPECT_DEATH(simulate([] {
                 mutex m;
                 condition_variable_any().wait(m);
               }),
               "a task unlocks a mutex that it does not hold");
  EXPECT_DEATH(simulate([] {
                 auto c = std::make_unique<condition_variable_any>("gone");
                 mutex m;
                 thread waiter([&] {
                   std::unique_lock lock(m);
                   c->wait(lock);
                 });
                 sleep_for(1ms);
                 c.reset();
               }),
               "destroyed while tasks wait for it: condition variable #[0-9]+ \"gone\"");
  EXPECT_DEATH(condition_variable_any().notify_one(), "outside a simulated task");
}

}  // namespace
}  // namespace waitpoint
