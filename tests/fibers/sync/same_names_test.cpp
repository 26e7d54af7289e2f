// SPDX-License-Identifier: BSD-3-Clause
// Every name of threads.hpp that same_source.cpp does not use. Built into two programs: with simulated threads, and
// with WAITPOINT_REAL_THREADS defined for all its files.
#include <gtest/gtest.h>

#include <functional>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include "fibers/sync/threads.hpp"

#ifndef WAITPOINT_REAL_THREADS
#include "tests/fibers/sync/orders.hpp"
#endif

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

void run(const std::function<void()>& body) {
#ifdef WAITPOINT_REAL_THREADS
  body();
#else
  in_every_order(body);
#endif
}

TEST(SameNames, Atomics) {
  run([] {
    threads::atomic<int> count(0, "count");
    threads::atomic<double> sum;
    threads::atomic_flag go("go");
    std::vector<threads::thread> all;
    for (int i = 0; i < 4; ++i)
      all.emplace_back([&] {
        go.wait(false);
        ++count;
        for (double old = sum.load(std::memory_order_relaxed); !sum.compare_exchange_weak(old, old + 0.5);) continue;
        threads::atomic_thread_fence(std::memory_order_seq_cst);
        count.notify_one();
      });
    EXPECT_FALSE(go.test_and_set());
    go.notify_all();
    for (int seen = count; seen != 4; seen = count) count.wait(seen);
    for (threads::thread& t : all) t.join();
    EXPECT_EQ(sum.exchange(0), 2.0);
    count = 7;
    EXPECT_EQ(count.fetch_sub(2), 7);
    EXPECT_TRUE(go.test());
  });
}

TEST(SameNames, MutexesWithOptions) {
  run([] {
    threads::priority_mutex inherits("inherits");
    threads::priority_mutex with_ceiling({.protocol = threads::LockProtocol::ceiling, .ceiling = 5});
    int inside = 0, total = 0;
    std::vector<threads::thread> all;
    for (int i = 0; i < 3; ++i)
      all.emplace_back([&] {
        for (int k = 0; k < 5; ++k) {
          const std::scoped_lock both(inherits, with_ceiling);
          EXPECT_EQ(++inside, 1);
          threads::this_thread::yield();
          --inside;
          ++total;
        }
      });
    for (threads::thread& t : all) t.join();
    EXPECT_EQ(total, 15);
    inherits.lock();
    threads::thread([&] {
      EXPECT_FALSE(inherits.try_lock());
      EXPECT_FALSE(inherits.try_lock_for(1ms));
      EXPECT_FALSE(inherits.try_lock_until(threads::steady_clock::now() + 1ms));
      EXPECT_FALSE(inherits.try_lock_until(threads::system_clock::now() + 1ms));
    }).join();
    inherits.unlock();
    EXPECT_TRUE(inherits.try_lock_for(1ms));
    inherits.unlock();
  });
}

TEST(SameNames, WaitsThatAStopRequestEnds) {
  run([] {
    threads::mutex m;
    threads::condition_variable_any changed;
    threads::jthread waiter([&](const threads::stop_token& token) {
      std::unique_lock lock(m);
      EXPECT_FALSE(changed.wait(lock, token, [] { return false; }));
      EXPECT_FALSE(changed.wait_for(lock, token, 1h, [] { return false; }));
    });
    threads::this_thread::sleep_for(1ms);
  });
}

TEST(SameNames, FuturesAndTheirMakers) {
  run([] {
    threads::promise<int> gives;
    threads::shared_future<int> takes = gives.get_future().share();
    threads::packaged_task<int(int)> doubles([](int a) { return 2 * a; });
    threads::future<int> doubled = doubles.get_future();
    EXPECT_EQ(takes.wait_for(1ms), std::future_status::timeout);
    EXPECT_EQ(takes.wait_until(threads::steady_clock::now() + 1ms), std::future_status::timeout);
    EXPECT_EQ(takes.wait_until(threads::system_clock::now() + 1ms), std::future_status::timeout);
    threads::thread gives_it([&] {
      gives.set_value(3);
      doubles(4);
    });
    EXPECT_EQ(takes.get(), 3);
    EXPECT_EQ(doubled.get(), 8);
    gives_it.join();
    threads::future<int> own = threads::async(
        threads::launch::async, [](int a) { return a; }, 5);
    EXPECT_EQ(own.get(), 5);
    EXPECT_EQ(threads::async(threads::launch::deferred, [] { return 6; }).get(), 6);
    threads::future<void> broken = threads::promise<void>().get_future();
    EXPECT_THROW(broken.get(), std::future_error);
  });
}

TEST(SameNames, Once) {
  run([] {
    threads::once_flag flag("once");
    int calls = 0;
    std::vector<threads::thread> all;
    for (int i = 0; i < 4; ++i)
      all.emplace_back([&] {
        threads::call_once(flag, [&] {
          threads::this_thread::sleep_for(1ms);
          ++calls;
        });
        EXPECT_EQ(calls, 1);
      });
    for (threads::thread& t : all) t.join();
  });
}

TEST(SameNames, StoppingThreads) {
  run([] {
    threads::atomic<int> called(0);
    threads::jthread worker({.name = "worker"}, [](const threads::stop_token& stop) {
      while (!stop.stop_requested()) threads::this_thread::sleep_for(1ms);
    });
    threads::stop_source source = worker.get_stop_source();
    const threads::stop_callback callback(worker.get_stop_token(), [&] { ++called; });
    EXPECT_TRUE(source.request_stop());
    worker.join();
    EXPECT_EQ(called, 1);
    EXPECT_FALSE(threads::stop_source(threads::nostopstate).stop_possible());
    const threads::jthread joined([] { threads::this_thread::sleep_for(1ms); });
  });
}

TEST(SameNames, LocksOfEveryKind) {
  run([] {
    threads::recursive_mutex again("again");
    threads::recursive_timed_mutex again_in_time("again in time");
    threads::shared_mutex map("map");
    threads::shared_timed_mutex map_in_time("map in time");
    const std::scoped_lock all(again, again_in_time);
    EXPECT_TRUE(again.try_lock());
    EXPECT_TRUE(again_in_time.try_lock_for(1ms));
    again.unlock();
    again_in_time.unlock();
    const std::shared_lock reads(map);
    const std::shared_lock reads_too(map_in_time);
    threads::thread other([&] {
      EXPECT_TRUE(map.try_lock_shared());
      map.unlock_shared();
      EXPECT_FALSE(map_in_time.try_lock_for(1ms));
      EXPECT_FALSE(again.try_lock());
      EXPECT_FALSE(again_in_time.try_lock_until(threads::steady_clock::now() + 1ms));
    });
    other.join();
  });
}

TEST(SameNames, MeetingPoints) {
  run([] {
    threads::latch ready(2, "ready");
    threads::barrier<> rounds(2);
    threads::recursive_mutex mutex;
    threads::condition_variable_any changed("changed");
    int done = 0;
    threads::thread other([&] {
      ready.arrive_and_wait();
      for (int i = 0; i < 3; ++i) rounds.arrive_and_wait();
      const std::lock_guard guard(mutex);
      ++done;
      changed.notify_all();
    });
    ready.count_down();
    ready.wait();
    EXPECT_TRUE(ready.try_wait());
    for (int i = 0; i < 3; ++i) rounds.arrive_and_wait();
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return done == 1; });
    EXPECT_FALSE(changed.wait_for(lock, 1ms, [&] { return done == 2; }));
    lock.unlock();
    other.join();
  });
}

TEST(SameNames, LocalsAndIds) {
  run([] {
    threads::fiber_local<int> own([] { return 10; });
    *own += 1;
    const auto id = threads::this_thread::get_id();
    threads::thread other([&] {
      EXPECT_EQ(*own, 10);
      *own = 20;
      EXPECT_NE(threads::this_thread::get_id(), id);
    });
    other.join();
    EXPECT_EQ(own.get(), 11);
    EXPECT_GE(threads::thread::hardware_concurrency(), 0u);
  });
}

TEST(SameNames, TheSystemClockIsADate) {
  run([] {
    const auto begin = threads::system_clock::now();
    const auto date = std::chrono::floor<std::chrono::days>(threads::system_clock::to_sys(begin));
    EXPECT_GE(std::chrono::year_month_day(date).year(), std::chrono::year(2000));
    threads::this_thread::sleep_until(begin + 2ms);
    EXPECT_GE(threads::system_clock::now() - begin, 2ms);
    EXPECT_GE(threads::system_clock::to_time_t(begin), 946'684'800);
  });
}

}  // namespace
}  // namespace waitpoint
