// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/condition_variable.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <new>
#include <set>
#include <string>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using Lock = std::unique_lock<mutex>;

TEST(ConditionVariable, NoItemIsLostOrDoubledInABoundedBuffer) {
  in_every_order([] {
    mutex m;
    condition_variable not_full, not_empty;
    std::deque<int> buffer;
    std::multiset<int> taken;
    std::vector<thread> threads;
    for (int producer = 0; producer < 3; ++producer)
      threads.emplace_back([&, producer] {
        for (int i = 0; i < 20; ++i) {
          Lock lock(m);
          not_full.wait(lock, [&] { return buffer.size() < 2; });
          buffer.push_back(producer * 100 + i);
          not_empty.notify_one();
        }
      });
    for (int consumer = 0; consumer < 3; ++consumer)
      threads.emplace_back([&] {
        for (int i = 0; i < 20; ++i) {
          Lock lock(m);
          while (buffer.empty()) not_empty.wait(lock);
          taken.insert(buffer.front());
          buffer.pop_front();
          lock.unlock();
          not_full.notify_one();
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(taken.size(), 60u);
    EXPECT_EQ(std::set<int>(taken.begin(), taken.end()).size(), 60u);
  });
}

TEST(ConditionVariable, WaitingReleasesTheMutexAndHasItAgainAfterwards) {
  in_every_order([] {
    mutex m;
    condition_variable c;
    bool ready = false, waiting = false;
    thread waiter([&] {
      Lock lock(m);
      waiting = true;
      c.wait(lock, [&] { return ready; });
      EXPECT_TRUE(lock.owns_lock());
      EXPECT_EQ(now(), at(8ms));
      thread other([&] { EXPECT_FALSE(m.try_lock()); });
      other.join();
    });
    sleep_for(5ms);
    {
      const Lock lock(m);
      EXPECT_TRUE(waiting);
      ready = true;
      c.notify_one();
      sleep_for(3ms);  // after its wake-up at 5 ms it waits for the mutex
    }
    waiter.join();
  });
}

// The number of four waiters that `notify` wakes.
int woken_by(const std::function<void(condition_variable&)>& notify, std::string* order = nullptr) {
  int woken = 0;
  in_order([&] {
    mutex m;
    condition_variable c;
    bool over = false;
    std::vector<thread> threads;
    for (const char name : {'a', 'b', 'c', 'd'})
      threads.emplace_back([&, name] {
        Lock lock(m);
        c.wait(lock);
        if (!over) ++woken;
        if (order != nullptr) *order += name;
      });
    sleep_for(1ms);
    notify(c);
    sleep_for(1ms);
    over = true;
    c.notify_all();
    for (thread& t : threads) t.join();
  });
  return woken;
}

TEST(ConditionVariable, NotifyOneWakesExactlyOneTheFirstThatWaited) {
  std::string order;
  EXPECT_EQ(woken_by([](condition_variable& c) { c.notify_one(); }, &order), 1);
  EXPECT_EQ(order, "abcd");
  EXPECT_EQ(woken_by([](condition_variable& c) { c.notify_one(), c.notify_one(); }), 2);
}

TEST(ConditionVariable, NotifyAllWakesAll) {
  EXPECT_EQ(woken_by([](condition_variable& c) { c.notify_all(); }), 4);
}

TEST(ConditionVariable, ANotificationWithoutWaitersIsNotKept) {
  in_every_order([] {
    mutex m;
    condition_variable c;
    c.notify_one();
    c.notify_all();
    Lock lock(m);
    EXPECT_EQ(c.wait_for(lock, 1ms), cv_status::timeout);
  });
}

TEST(ConditionVariable, TimesOutAtTheDeadlineHoldingTheLock) {
  in_every_order([] {
    mutex m;
    condition_variable c;
    Lock lock(m);
    EXPECT_EQ(c.wait_for(lock, 5ms), cv_status::timeout);
    EXPECT_EQ(now(), at(5ms));
    EXPECT_EQ(c.wait_until(lock, steady_clock::time_point(7ms)), cv_status::timeout);
    EXPECT_EQ(now(), at(7ms));
    EXPECT_EQ(c.wait_until(lock, steady_clock::time_point(1ms)), cv_status::timeout);
    EXPECT_EQ(c.wait_for(lock, -1h), cv_status::timeout);
    EXPECT_EQ(now(), at(7ms));
    EXPECT_FALSE(c.wait_for(lock, 2ms, [] { return false; }));
    EXPECT_EQ(now(), at(9ms));
    EXPECT_TRUE(c.wait_for(lock, 2ms, [] { return now() >= at(11ms); }));  // true only at the deadline
    EXPECT_TRUE(c.wait_until(lock, steady_clock::time_point(), [] { return true; }));
    EXPECT_EQ(now(), at(11ms));
    EXPECT_TRUE(lock.owns_lock());
    thread other([&] { EXPECT_FALSE(m.try_lock()); });
    other.join();
  });
}

// As in the standard: a notified task no longer needs the condition variable, though it still waits for the mutex.
TEST(ConditionVariable, MayBeDestroyedAsSoonAsAllAreNotified) {
  in_every_order([] {
    mutex m;
    alignas(condition_variable) unsigned char memory[sizeof(condition_variable)];
    auto* c = new (memory) condition_variable;
    std::vector<thread> threads;
    int woken = 0;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&, i] {
        Lock lock(m);
        if (i == 0)
          EXPECT_EQ(c->wait_for(lock, 1h), cv_status::no_timeout);
        else
          c->wait(lock);
        ++woken;
      });
    sleep_for(5ms);
    {
      const Lock lock(m);
      c->notify_one();
      c->notify_all();
      c->~condition_variable();
      std::memset(memory, 0xAB, sizeof memory);
      EXPECT_EQ(woken, 0);
    }
    for (thread& t : threads) t.join();
    EXPECT_EQ(woken, 4);
    for (const unsigned char byte : memory) ASSERT_EQ(byte, 0xAB);
  });
}

TEST(ConditionVariable, TimedWaitsAreWokenInTime) {
  in_every_order([] {
    mutex m;
    condition_variable c;
    int tokens = 0;
    thread waiter([&] {
      Lock lock(m);
      EXPECT_EQ(c.wait_for(lock, 5ms), cv_status::no_timeout);
      EXPECT_EQ(now(), at(2ms));
      EXPECT_TRUE(c.wait_for(lock, 5ms, [&] { return tokens == 2; }));
      EXPECT_EQ(now(), at(6ms));
      EXPECT_EQ(c.wait_until(lock, steady_clock::time_point::max()), cv_status::no_timeout);
      EXPECT_EQ(now(), at(8ms));
    });
    for (const auto span : {2ms, 2ms, 2ms}) {
      sleep_for(span);
      const Lock lock(m);
      if (now() > at(2ms)) ++tokens;
      c.notify_one();
    }
    sleep_for(2ms);
    c.notify_one();
    waiter.join();
  });
}

// A notification at the instant of a deadline wakes exactly one task: it is neither lost nor counted twice.
TEST(ConditionVariable, NotifiedAtTheInstantOfTheDeadlineNothingIsLost) {
  expect_both([] {
    mutex m;
    condition_variable c;
    int woken = 0;
    bool notified = false;
    std::vector<thread> threads;
    for (int i = 0; i < 2; ++i)
      threads.emplace_back([&, i] {
        Lock lock(m);
        // One waits until the very instant of the notification, the other beyond it.
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

}  // namespace
}  // namespace waitpoint
