// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/atomic.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(Atomic, IntegersDoWhatTheStandardSays) {
  in_every_order([] {
    atomic<int> a(5);
    EXPECT_EQ(a.fetch_add(3), 5);
    EXPECT_EQ(a.fetch_sub(2), 8);
    EXPECT_EQ(a.fetch_and(6), 6);
    EXPECT_EQ(a.fetch_or(9), 6);
    EXPECT_EQ(a.fetch_xor(5), 15);
    EXPECT_EQ(a, 10);
    EXPECT_EQ(a++, 10);
    EXPECT_EQ(++a, 12);
    EXPECT_EQ(a--, 12);
    EXPECT_EQ(--a, 10);
    EXPECT_EQ(a += 5, 15);
    EXPECT_EQ(a -= 1, 14);
    EXPECT_EQ(a &= 12, 12);
    EXPECT_EQ(a |= 3, 15);
    EXPECT_EQ(a ^= 1, 14);
    EXPECT_EQ(a = 3, 3);
    EXPECT_EQ(a.exchange(4), 3);
    a.store(7, memory_order_release);
    EXPECT_EQ(a.load(memory_order_acquire), 7);
    int expected = 6;
    EXPECT_FALSE(a.compare_exchange_strong(expected, 1));
    EXPECT_EQ(expected, 7);
    EXPECT_TRUE(a.compare_exchange_weak(expected, 1, memory_order_acq_rel, memory_order_relaxed));
    EXPECT_EQ(a.load(), 1);
    EXPECT_TRUE(a.is_lock_free());
    EXPECT_EQ(now(), Time());
  });
}

TEST(Atomic, IntegersWrapAround) {
  in_order([] {
    atomic<int> a(std::numeric_limits<int>::max());
    EXPECT_EQ(++a, std::numeric_limits<int>::min());
    EXPECT_EQ(--a, std::numeric_limits<int>::max());
    atomic<std::uint8_t> b(255);
    b.fetch_add(2);
    EXPECT_EQ(b, 1);
    atomic<std::int64_t> c(std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(c -= 1, std::numeric_limits<std::int64_t>::max());
  });
}

TEST(Atomic, PointersFloatsBooleansAndStructures) {
  in_order([] {
    int array[5] = {};
    atomic<int*> p(array);
    EXPECT_EQ(p.fetch_add(2), array);
    EXPECT_EQ(p++, array + 2);
    EXPECT_EQ(p -= 1, array + 2);
    atomic<double> d(1.5);
    EXPECT_EQ(d.fetch_add(1.0), 1.5);
    EXPECT_EQ(d -= 0.5, 2.0);
    double zero = 0.0;
    d = -0.0;
    EXPECT_FALSE(d.compare_exchange_strong(zero, 1.0));  // the bits differ
    atomic<bool> b;
    EXPECT_FALSE(b.exchange(true));
    EXPECT_TRUE(b);
    struct Pair {
      short a;
      short b;
    };
    atomic<Pair> pair(Pair{1, 2});
    Pair expected = {1, 3};
    EXPECT_FALSE(pair.compare_exchange_strong(expected, Pair{4, 5}));
    EXPECT_EQ(expected.b, 2);
    EXPECT_TRUE(pair.compare_exchange_strong(expected, Pair{4, 5}));
    EXPECT_EQ(pair.load().a, 4);
    atomic deduced = 3L;
    static_assert(std::is_same_v<decltype(deduced)::value_type, long>);
  });
}

// Some schedule finds the lost updates of load and store, none finds one of fetch_add: operations are waitpoints.
TEST(Atomic, SchedulesInterleaveAtEveryOperation) {
  std::set<int> torn, whole;
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    const Report report = simulate(
        [&] {
          atomic<int> a(0), b(0);
          std::vector<thread> all;
          for (int i = 0; i < 3; ++i)
            all.emplace_back([&] {
              a.store(a.load() + 1);
              b.fetch_add(1);
            });
          for (thread& t : all) t.join();
          torn.insert(a);
          whole.insert(b);
        },
        order_number(number));
    ASSERT_TRUE(report.passed) << report;
  }
  EXPECT_EQ(torn, (std::set<int>{1, 2, 3}));
  EXPECT_EQ(whole, std::set<int>{3});
}

TEST(Atomic, ASpinLockKeepsOthersOut) {
  in_every_order([] {
    atomic_flag lock;
    int inside = 0, most = 0, total = 0;
    std::vector<thread> all;
    for (int i = 0; i < 4; ++i)
      all.emplace_back([&] {
        for (int k = 0; k < 5; ++k) {
          while (lock.test_and_set(memory_order_acquire)) this_thread::yield();
          most = std::max(most, ++inside);
          waitpoint::atomic_thread_fence(memory_order_seq_cst);
          ++total;
          --inside;
          lock.clear(memory_order_release);
        }
      });
    for (thread& t : all) t.join();
    EXPECT_EQ(most, 1);
    EXPECT_EQ(total, 20);
    EXPECT_FALSE(lock.test());
  });
}

TEST(Atomic, WaitsUntilTheValueIsAnotherAndItIsNotified) {
  in_every_order([] {
    atomic<int> a(1);
    a.wait(2);
    EXPECT_EQ(now(), Time());
    thread changes([&] {
      sleep_for(2ms);
      a.notify_all();  // the value is unchanged: no task continues
      sleep_for(1ms);
      a = 2;
      sleep_for(1ms);
      compute(1ms);
      a.notify_one();
    });
    a.wait(1);
    EXPECT_EQ(now(), at(5ms));
    EXPECT_EQ(a, 2);
    changes.join();
  });
}

TEST(Atomic, NotifyOneWakesOneAndNotifyAllAll) {
  in_every_order([] {
    atomic_flag flag("go");
    int awake = 0;
    std::vector<thread> all;
    for (int i = 0; i < 4; ++i)
      all.emplace_back([&] {
        flag.wait(false);
        ++awake;
      });
    sleep_for(1ms);
    EXPECT_FALSE(flag.test_and_set());
    sleep_for(1ms);
    EXPECT_EQ(awake, 0);
    flag.notify_one();
    sleep_for(1ms);
    EXPECT_EQ(awake, 1);
    flag.notify_all();
    for (thread& t : all) t.join();
    EXPECT_EQ(awake, 4);
  });
}

TEST(Atomic, TimedWaitsEndAtTheDeadline) {
  in_every_order([] {
    atomic<int> a(1);
    EXPECT_FALSE(a.try_wait_for(1, 0s));
    EXPECT_FALSE(a.try_wait_for(1, -1s));
    EXPECT_TRUE(a.try_wait_for(2, 0s));
    EXPECT_EQ(now(), Time());
    EXPECT_FALSE(a.try_wait_for(1, 2ms));
    EXPECT_EQ(now(), at(2ms));
    EXPECT_FALSE(a.try_wait_until(1, steady_clock::time_point(5ms)));
    EXPECT_EQ(now(), at(5ms));
    EXPECT_FALSE(atomic_flag().try_wait_until(false, system_clock::now() + 1ms));
    EXPECT_FALSE(atomic_flag().try_wait_for(false, 1ms));
    thread changes([&] {
      sleep_for(1ms);
      a = 2;
      a.notify_one();
    });
    EXPECT_TRUE(a.try_wait_for(1, 1h));
    EXPECT_EQ(now(), at(8ms));
    changes.join();
  });
}

TEST(Atomic, ChangedAtTheInstantOfTheDeadlineIsSeenOrNotButNeverLost) {
  expect_both([] {
    atomic<int> a(1);
    bool seen = false;
    thread waits([&] { seen = a.try_wait_for(1, 5ms); });
    sleep_for(5ms);
    a = 2;
    a.notify_one();
    waits.join();
    EXPECT_TRUE(a.try_wait_for(1, 0s));
    EXPECT_EQ(now(), at(5ms));
    return seen;
  });
}

TEST(Atomic, WaitingForAConstantValueIsReported) {
  const Report blocked = simulate([] {
    const atomic<bool> ready(false, "ready");
    ready.wait(false);
  });
  EXPECT_EQ(blocked.end, RunEnd::deadlock);
  EXPECT_NE(blocked.text.find("waits (wait) for atomic #1 \"ready\""), std::string::npos) << blocked;
  const Report spins = simulate([] {
    const atomic<bool> ready(false, "ready");
    while (!ready) {
    }
  });
  EXPECT_EQ(spins.end, RunEnd::no_progress);
  EXPECT_NE(spins.text.find("atomic_test.cpp"), std::string::npos) << spins;
}

TEST(Atomic, SpinningTasksUnwindAndDestructorsTakeEffect) {
  static int released;
  released = 0;
  const Report report = simulate([] {
    auto uses = std::make_shared<atomic<int>>(2);
    for (int i = 0; i < 2; ++i)
      thread({.name = "service", .service = true}, [uses] {
        struct Use {
          ~Use() { released += uses.fetch_sub(1); }
          atomic<int>& uses;
        };
        const Use use{*uses};
        for (;;) {
          (void)uses->load();
          sleep_for(1ms);
        }
      }).detach();
    sleep_for(20ms);
  });
  EXPECT_TRUE(report.passed && report.abandoned.empty()) << report;
  EXPECT_EQ(released, 3);
}

TEST(Atomic, StartsEachRunWithItsValueOutside) {
  atomic<int> a(3);
  for (int run = 0; run < 2; ++run) {
    in_order([&] {
      EXPECT_EQ(a, 3);
      a = 8;
    });
    EXPECT_EQ(a, 8);
  }
  a = 5;
  a.notify_all();
  in_order([&] { EXPECT_EQ(a.exchange(6), 5); });
  EXPECT_EQ(a, 6);
}

TEST(AtomicDeathTest, OrdersThatTheStandardForbids) {
  EXPECT_DEATH((void)atomic<int>().load(memory_order_release), "load with a release order");
  EXPECT_DEATH(atomic<int>().store(1, memory_order_acquire), "store with an acquire order");
  EXPECT_DEATH(atomic<int>().wait(1, memory_order_acq_rel), "load with a release order");
  int expected = 0;
  EXPECT_DEATH(atomic<int>().compare_exchange_weak(expected, 1, memory_order_seq_cst, memory_order_release),
               "a release order for its failure");
}

TEST(AtomicDeathTest, WaitingOutsideAnyTask) {
  EXPECT_DEATH(atomic<int>().wait(0), "a simulated primitive is used outside a simulated task");
}

}  // namespace
}  // namespace waitpoint
