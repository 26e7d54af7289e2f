// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/barrier.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(Barrier, KeepsTasksInStepPhaseByPhase) {
  in_every_order([] {
    int phases = 0;
    std::vector<int> rounds(4);
    const auto completion = [&]() noexcept {
      ++phases;
      for (const int round : rounds) EXPECT_EQ(round, phases);
    };
    barrier step(4, completion, "step");
    std::vector<thread> threads;
    for (std::size_t t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (int i = 1; i <= 6; ++i) {
          sleep_for((t + static_cast<std::size_t>(i)) % 3 * 1ms);
          rounds[t] = i;
          step.arrive_and_wait();
          EXPECT_EQ(phases, i);
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(phases, 6);
  });
}

TEST(Barrier, TheLastToArriveCompletesThePhaseBeforeAnyoneGoesOn) {
  in_every_order([] {
    thread::id completed_by;
    Time completed_at;
    bool through = false;
    const auto completion = [&]() noexcept {
      EXPECT_FALSE(through);
      completed_by = this_thread::get_id();
      completed_at = now();
    };
    barrier b(2, completion);
    thread early([&] {
      b.arrive_and_wait();
      through = true;
      EXPECT_EQ(now(), at(3ms));
    });
    sleep_for(3ms);
    b.arrive_and_wait();
    EXPECT_EQ(completed_by, this_thread::get_id());
    EXPECT_EQ(completed_at, at(3ms));
    early.join();
  });
}

TEST(Barrier, ArrivingDoesNotWaitAndTheTokenIsGoodForThePhaseAndTheNext) {
  in_every_order([] {
    barrier b(3);
    auto token = b.arrive(2);
    EXPECT_FALSE(b.try_wait(token));
    thread other([&] {
      sleep_for(2ms);
      (void)b.arrive();
    });
    b.wait(std::move(token));
    EXPECT_EQ(now(), at(2ms));
    other.join();
    auto late = b.arrive(3);
    b.wait(std::move(late));  // the phase is already complete
    EXPECT_EQ(now(), at(2ms));
  });
}

TEST(Barrier, ArriveAndDropReducesTheExpectedCount) {
  in_every_order([] {
    barrier b(3);
    thread leaves([&] {
      sleep_for(1ms);
      b.arrive_and_drop();
      EXPECT_EQ(now(), at(1ms));
    });
    thread stays([&] {
      for (int i = 0; i < 3; ++i) b.arrive_and_wait();
      EXPECT_EQ(now(), at(5ms));
    });
    b.arrive_and_wait();
    EXPECT_EQ(now(), at(1ms));
    sleep_for(1ms);
    b.arrive_and_wait();
    EXPECT_EQ(now(), at(2ms));
    sleep_for(3ms);
    b.arrive_and_wait();
    leaves.join();
    stays.join();
  });
}

TEST(Barrier, TimedWaitsEndAtTheDeadlineOrInTime) {
  in_every_order([] {
    barrier b(2);
    thread other([&] {
      auto token = b.arrive();
      EXPECT_FALSE(b.try_wait_for(token, 0s));
      EXPECT_FALSE(b.try_wait_for(token, -1h));
      EXPECT_FALSE(b.try_wait_until(token, steady_clock::time_point()));
      EXPECT_EQ(now(), Time());
      EXPECT_FALSE(b.try_wait_for(token, 2ms));
      EXPECT_EQ(now(), at(2ms));
      EXPECT_FALSE(b.try_wait_until(token, steady_clock::time_point(3ms)));
      EXPECT_EQ(now(), at(3ms));
      EXPECT_TRUE(b.try_wait_for(token, std::chrono::hours::max()));
      EXPECT_EQ(now(), at(7ms));
    });
    sleep_for(7ms);
    b.arrive_and_wait();
    other.join();
  });
}

TEST(Barrier, CompletedAtTheInstantOfTheDeadlineBothAreSound) {
  expect_both([] {
    barrier b(2);
    bool over = false;
    thread waiter([&] {
      auto token = b.arrive();
      over = b.try_wait_for(token, 5ms);
      EXPECT_EQ(now(), at(5ms));
      if (!over) b.wait(std::move(token));
      EXPECT_EQ(now(), at(5ms));
    });
    sleep_for(5ms);
    b.arrive_and_wait();
    waiter.join();
    return over;
  });
}

TEST(Barrier, StateOfAnotherRunIsForgotten) {
  static barrier<> left(2);
  for (int repeat = 0; repeat < 3; ++repeat) {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {}, [] {
      left.arrive_and_drop();
      left.arrive_and_wait();
      auto token = left.arrive();  // the only participant now
      EXPECT_TRUE(left.try_wait(token));
    });
    simulation.spawn(simulation.environment(), {}, [] { sleep_for(1h); });
    EXPECT_EQ(simulation.run_before(at(1ms)), RunEnd::time_reached);
  }
}

TEST(BarrierDeathTest, MisuseHasAName) {
  const char* message = "more arrivals at a barrier than it expects: barrier #1";
  EXPECT_DEATH(simulate([] { (void)barrier(2).arrive(3); }), message);
  EXPECT_DEATH(simulate([] { (void)barrier(2).arrive(0); }), message);
  EXPECT_DEATH(simulate([] { (void)barrier(2).arrive(-1); }), message);
  EXPECT_DEATH(simulate([] { barrier(0).arrive_and_wait(); }), message);
  EXPECT_DEATH(simulate([] {
                 barrier b(1);
                 b.arrive_and_drop();
                 b.arrive_and_drop();
               }),
               message);
  EXPECT_DEATH(barrier(-1), "a barrier expects a negative count");
  EXPECT_DEATH((void)barrier(1).arrive(), "outside a simulated task");
  EXPECT_DEATH(simulate([] {
                 barrier here(2), there(2);
                 here.wait(there.arrive());
               }),
               "a task waits at a barrier where it did not arrive");
  EXPECT_DEATH(simulate([] {
                 barrier b(1);
                 auto token = b.arrive();
                 b.wait(std::move(token));
                 b.wait(std::move(token));
               }),
               "a task waits at a barrier where it did not arrive");
  EXPECT_DEATH(simulate([] {
                 barrier b(1);
                 auto token = b.arrive();
                 b.arrive_and_wait();
                 b.wait(std::move(token));
               }),
               "a task waits for an outdated phase of a barrier: barrier #1");
  EXPECT_DEATH(simulate([] {
                 auto gone = std::make_unique<barrier<>>(2);
                 thread waiter([&] { gone->arrive_and_wait(); });
                 sleep_for(1ms);
                 gone.reset();
               }),
               "destroyed while tasks wait for it: barrier #[0-9]+");
}

}  // namespace
}  // namespace waitpoint
