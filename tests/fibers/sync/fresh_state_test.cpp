// SPDX-License-Identifier: BSD-3-Clause
// Static objects are in their initial state in a new run, whatever an aborted run did to them.
#include <gtest/gtest.h>

#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

mutex left_locked("left locked");
timed_mutex left_waited_for;
condition_variable left_waiting;
counting_semaphore<> left_empty(2);
thread left_running;

// Ends while one task holds the objects and the others wait.
void run_that_breaks_off() {
  Simulation simulation;
  simulation.spawn(simulation.environment(), {}, [] {
    left_locked.lock();
    left_waited_for.lock();
    left_empty.acquire();
    left_empty.acquire();
    left_running = thread([] { sleep_for(1h); });
    sleep_for(1h);
  });
  const std::function<void()> waiters[] = {
      [] { left_locked.lock(); },
      [] { (void)left_waited_for.try_lock_for(2h); },
      [] { left_empty.acquire(); },
      [] { (void)left_empty.try_acquire_for(2h); },
      [] {
        mutex m;
        std::unique_lock lock(m);
        left_waiting.wait(lock);
      },
  };
  for (const auto& wait : waiters)
    simulation.spawn(simulation.environment(), {}, [wait] {
      sleep_for(1ms);
      wait();
      ADD_FAILURE() << "nothing was there to be had";
    });
  EXPECT_EQ(simulation.run_before(Time() + Duration(1s)), RunEnd::time_reached);
}

TEST(FreshState, PrimitivesReadAsFreshInTheNextRun) {
  for (int repeat = 0; repeat < 3; ++repeat) {
    run_that_breaks_off();
    in_order([] {
      EXPECT_TRUE(left_locked.try_lock());
      left_locked.unlock();
      EXPECT_TRUE(left_waited_for.try_lock_for(0s));
      left_waited_for.unlock();
      left_waiting.notify_all();
      EXPECT_TRUE(left_empty.try_acquire());
      EXPECT_TRUE(left_empty.try_acquire());
      EXPECT_FALSE(left_empty.try_acquire());
      left_empty.release();
      EXPECT_EQ(now(), Time());
    });
    left_running = thread();  // its run has ended: no join is needed
  }
}

TEST(FreshState, ARunAfterAnAbortedOneIsTheSameAsWithoutIt) {
  const auto body = [] {
    thread other([] {
      const std::lock_guard guard(left_locked);
      sleep_for(2ms);
      left_empty.release();
    });
    left_empty.acquire();
    {
      const std::lock_guard guard(left_locked);
      sleep_for(1ms);
    }
    other.join();
  };
  const Digest before = in_order(body).digest;
  run_that_breaks_off();
  EXPECT_EQ(in_order(body).digest, before);
}

TEST(FreshStateDeathTest, AMutexLockedInAnotherRunIsNotHeldInThisOne) {
  run_that_breaks_off();
  EXPECT_DEATH(simulate([] { left_locked.unlock(); }), "unlocks a mutex that it does not hold");
}

}  // namespace
}  // namespace waitpoint
