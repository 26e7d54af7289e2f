// SPDX-License-Identifier: BSD-3-Clause
// Waits of condition_variable_any that end at a stop request.
#include <gtest/gtest.h>

#include <mutex>
#include <vector>

#include "fibers/sync/condition_variable_any.hpp"
#include "fibers/sync/jthread.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/recursive_mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

bool never() { return false; }

TEST(StoppableWait, EndsAtTheInstantOfTheRequestWithTheLockHeld) {
  in_every_order([] {
    mutex m;
    condition_variable_any changed;
    stop_source source;
    std::vector<thread> threads;
    int ended = 0;
    for (int kind = 0; kind < 3; ++kind)
      threads.emplace_back([&, kind] {
        std::unique_lock lock(m);
        const stop_token token = source.get_token();
        const bool ready = kind == 0   ? changed.wait(lock, token, never)
                           : kind == 1 ? changed.wait_for(lock, token, 1h, never)
                                       : changed.wait_until(lock, token, steady_clock::time_point(1h), never);
        EXPECT_FALSE(ready);
        EXPECT_TRUE(lock.owns_lock());
        EXPECT_EQ(now(), at(5ms));
        ++ended;
      });
    sleep_for(5ms);
    EXPECT_TRUE(source.request_stop());
    for (thread& t : threads) t.join();
    EXPECT_EQ(ended, 3);
  });
}

TEST(StoppableWait, ReturnsWhatThePredicateSaysInTheEnd) {
  in_every_order([] {
    recursive_mutex m;
    condition_variable_any changed;
    stop_source source;
    std::unique_lock lock(m);
    // Satisfied at once, by a notification, at the deadline, and at the request.
    EXPECT_TRUE(changed.wait(lock, source.get_token(), [] { return true; }));
    EXPECT_EQ(now(), Time());
    bool ready = false;
    thread notifier([&] {
      sleep_for(1ms);
      const std::lock_guard guard(m);
      ready = true;
      changed.notify_one();
    });
    EXPECT_TRUE(changed.wait_for(lock, source.get_token(), 1h, [&] { return ready; }));
    EXPECT_EQ(now(), at(1ms));
    notifier.join();
    EXPECT_FALSE(changed.wait_for(lock, source.get_token(), 2ms, never));
    EXPECT_TRUE(
        changed.wait_until(lock, source.get_token(), steady_clock::time_point(7ms), [] { return now() >= at(7ms); }));
    EXPECT_EQ(now(), at(7ms));
    thread stopper([&] {
      sleep_for(2ms);
      source.request_stop();
    });
    EXPECT_TRUE(changed.wait(lock, source.get_token(), [] { return now() >= at(9ms); }));
    stopper.join();
    // After the request, or a past deadline, there is no further wait.
    EXPECT_FALSE(changed.wait(lock, source.get_token(), never));
    EXPECT_TRUE(changed.wait(lock, source.get_token(), [] { return true; }));
    EXPECT_FALSE(changed.wait_for(lock, stop_token(), -1ms, never));
    EXPECT_EQ(now(), at(9ms));
  });
}

TEST(StoppableWait, RequestWakesNoOtherWaiter) {
  in_every_order([] {
    mutex m;
    condition_variable_any changed;
    stop_source source;
    int asked = 0;
    bool over = false;
    thread other([&] {
      std::unique_lock lock(m);
      changed.wait(lock, [&] { return ++asked, over; });
    });
    thread stopped([&] {
      std::unique_lock lock(m);
      changed.wait(lock, source.get_token(), never);
    });
    sleep_for(1ms);
    source.request_stop();
    stopped.join();
    EXPECT_EQ(asked, 1);
    const std::unique_lock lock(m);
    over = true;
    changed.notify_all();
    m.unlock(), other.join(), m.lock();
    EXPECT_EQ(asked, 2);
  });
}

// The request comes at the instant at which the wait begins, anywhere between the first test of the token and the
// sleep.
TEST(StoppableWait, ARequestAtTheInstantOfTheWaitIsNotLost) {
  in_every_order([] {
    for (int repeat = 0; repeat < 8; ++repeat) {
      mutex m;
      condition_variable_any changed;
      jthread waiter([&](const stop_token& token) {
        std::unique_lock lock(m);
        EXPECT_FALSE(changed.wait(lock, token, [&] { return this_thread::yield(), false; }));
      });
      for (int i = 0; i < repeat; ++i) this_thread::yield();
    }  // ~jthread requests the stop and joins
    EXPECT_EQ(now(), Time());
  });
}

TEST(StoppableWait, RequestedAtTheInstantOfTheDeadlineEndsOnce) {
  expect_both([] {
    mutex m;
    condition_variable_any changed;
    stop_source source;
    bool asked_first = false;
    thread waiter([&] {
      std::unique_lock lock(m);
      int looks = 0;
      EXPECT_FALSE(changed.wait_for(lock, source.get_token(), 5ms, [&] { return ++looks, false; }));
      EXPECT_EQ(now(), at(5ms));
      EXPECT_EQ(looks, 2);
      asked_first = source.stop_requested();
    });
    sleep_for(5ms);
    source.request_stop();
    waiter.join();
    return asked_first;
  });
}

TEST(StoppableWait, IsUnwoundWithItsRun) {
  Simulation simulation;
  simulation.spawn(simulation.environment(), {}, [] {
    mutex m;
    condition_variable_any changed;
    jthread waiter([&](const stop_token& token) {
      std::unique_lock lock(m);
      changed.wait(lock, token, never);
      ADD_FAILURE();
    });
    sleep_for(1h);
  });
  EXPECT_EQ(simulation.run_before(at(1ms)), RunEnd::time_reached);
}

}  // namespace
}  // namespace waitpoint
