// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/latch.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(Latch, LetsAllThroughWhenTheCountIsZeroAndEverAfter) {
  in_every_order([] {
    latch done(3);
    std::vector<thread> threads;
    int through = 0;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        done.wait();
        EXPECT_EQ(now(), at(5ms));
        ++through;
      });
    sleep_for(2ms);
    done.count_down(2);
    EXPECT_FALSE(done.try_wait());
    sleep_for(3ms);
    EXPECT_EQ(through, 0);
    done.count_down();
    EXPECT_TRUE(done.try_wait());
    for (thread& t : threads) t.join();
    EXPECT_EQ(through, 4);
    done.wait();
    done.count_down(0);
    EXPECT_TRUE(done.try_wait_for(0s));
    EXPECT_EQ(now(), at(5ms));
  });
}

TEST(Latch, ArriveAndWaitMeets) {
  in_every_order([] {
    latch all(5);
    std::vector<thread> threads;
    for (int i = 1; i < 5; ++i)
      threads.emplace_back([&, i] {
        sleep_for(i * 1ms);
        all.arrive_and_wait();
        EXPECT_EQ(now(), at(4ms));
      });
    all.arrive_and_wait();
    EXPECT_EQ(now(), at(4ms));
    for (thread& t : threads) t.join();
    latch none(0);
    none.wait();
  });
}

TEST(Latch, TimedWaitsEndAtTheDeadlineOrInTime) {
  in_every_order([] {
    latch done(1);
    thread other([&] {
      EXPECT_FALSE(done.try_wait_for(0s));
      EXPECT_FALSE(done.try_wait_for(-1h));
      EXPECT_FALSE(done.try_wait_until(steady_clock::time_point()));
      EXPECT_EQ(now(), Time());
      EXPECT_FALSE(done.try_wait_for(2ms));
      EXPECT_EQ(now(), at(2ms));
      EXPECT_FALSE(done.try_wait_until(steady_clock::time_point(3ms)));
      EXPECT_EQ(now(), at(3ms));
      EXPECT_TRUE(done.try_wait_for(std::chrono::hours::max()));
      EXPECT_EQ(now(), at(7ms));
    });
    sleep_for(7ms);
    done.count_down();
    other.join();
  });
}

TEST(Latch, CountedDownAtTheInstantOfTheDeadlineBothAreSound) {
  expect_both([] {
    latch done(1);
    bool in_time = false;
    thread waiter([&] {
      in_time = done.try_wait_for(5ms);
      EXPECT_EQ(now(), at(5ms));
    });
    sleep_for(5ms);
    done.count_down();
    waiter.join();
    EXPECT_TRUE(done.try_wait());
    return in_time;
  });
}

TEST(Latch, StateOfAnotherRunIsForgotten) {
  static latch left(2);
  for (int repeat = 0; repeat < 3; ++repeat)
    in_order([] {
      EXPECT_FALSE(left.try_wait());
      left.count_down(2);
      left.wait();
    });
}

TEST(LatchDeathTest, MisuseHasAName) {
  const char* message = "a latch is counted down below zero: latch #1 \"few\"";
  EXPECT_DEATH(simulate([] { latch(1, "few").count_down(2); }), message);
  EXPECT_DEATH(simulate([] { latch(1, "few").count_down(-1); }), "counted down by a negative number");
  EXPECT_DEATH(simulate([] { latch(0, "few").arrive_and_wait(); }), message);
  EXPECT_DEATH(latch(-1), "a latch expects a negative count");
  EXPECT_DEATH(latch(1).wait(), "outside a simulated task");
  EXPECT_DEATH(simulate([] {
                 auto gone = std::make_unique<latch>(1);
                 thread waiter([&] { gone->wait(); });
                 sleep_for(1ms);
                 gone->count_down();
                 gone.reset();
               }),
               "destroyed while tasks wait for it: latch #[0-9]+");
}

}  // namespace
}  // namespace waitpoint
