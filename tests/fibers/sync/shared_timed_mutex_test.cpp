// SPDX-License-Identifier: BSD-3-Clause
// The timeouts of shared_timed_mutex; its common part with shared_mutex: shared_mutex_test.cpp.
#include <gtest/gtest.h>

#include "fibers/sync/shared_mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(SharedTimedMutex, TimesOutToTheNanosecondOrIsHadInTime) {
  in_every_order([] {
    shared_timed_mutex m;
    m.lock();
    thread writer([&] {
      for (const auto span : {0ns, -1ns, std::chrono::nanoseconds::min()}) EXPECT_FALSE(m.try_lock_for(span));
      EXPECT_FALSE(m.try_lock_until(steady_clock::time_point()));
      EXPECT_EQ(now(), Time());
      EXPECT_FALSE(m.try_lock_for(2ms + 1ns));
      EXPECT_EQ(now(), at(2ms + 1ns));
      EXPECT_TRUE(m.try_lock_until(steady_clock::time_point(9ms)));
      EXPECT_EQ(now(), at(6ms));
      m.unlock();
    });
    thread reader([&] {
      EXPECT_FALSE(m.try_lock_shared_for(0ns));
      EXPECT_FALSE(m.try_lock_shared_until(steady_clock::time_point()));
      EXPECT_EQ(now(), Time());
      EXPECT_FALSE(m.try_lock_shared_for(3ms));
      EXPECT_EQ(now(), at(3ms));
      EXPECT_TRUE(m.try_lock_shared_for(std::chrono::hours::max()));
      EXPECT_EQ(now(), at(6ms));
      m.unlock_shared();
    });
    sleep_for(6ms);
    m.unlock();
    writer.join();
    reader.join();
  });
}

TEST(SharedTimedMutex, ReadersComeInWhenTheWriterTheyWaitedBehindGivesUp) {
  in_every_order([] {
    shared_timed_mutex m;
    m.lock_shared();
    thread gives_up([&] {
      sleep_for(1ms);
      EXPECT_FALSE(m.try_lock_for(4ms));
    });
    thread behind([&] {
      sleep_for(2ms);
      EXPECT_FALSE(m.try_lock_shared());
      m.lock_shared();
      EXPECT_EQ(now(), at(5ms));
      m.unlock_shared();
    });
    thread also_behind([&] {
      sleep_for(3ms);
      EXPECT_TRUE(m.try_lock_shared_for(2ms + 1ns));
      EXPECT_EQ(now(), at(5ms));
      m.unlock_shared();
    });
    sleep_for(8ms);
    m.unlock_shared();
    for (thread* t : {&gives_up, &behind, &also_behind}) t->join();
    EXPECT_TRUE(m.try_lock());
    m.unlock();
  });
}

TEST(SharedTimedMutex, UnlockedAtTheInstantOfTheDeadlineEitherGetsItOrLeavesItFree) {
  for (const bool writer_waits : {true, false})
    for (const bool writer_holds : {true, false}) {
      if (!writer_waits && !writer_holds) continue;
      expect_both([&] {
        shared_timed_mutex m;
        writer_holds ? m.lock() : m.lock_shared();
        bool has = false;
        thread waiter([&] {
          has = writer_waits ? m.try_lock_for(5ms) : m.try_lock_shared_for(5ms);
          EXPECT_EQ(now(), at(5ms));
          if (has) writer_waits ? m.unlock() : m.unlock_shared();
        });
        sleep_for(5ms);
        writer_holds ? m.unlock() : m.unlock_shared();
        waiter.join();
        EXPECT_TRUE(m.try_lock());
        m.unlock();
        return has;
      });
    }
}

}  // namespace
}  // namespace waitpoint
