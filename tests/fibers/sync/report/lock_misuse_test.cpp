// SPDX-License-Identifier: BSD-3-Clause
// Each misuse of a lock is reported, and so is ending or destroying an object in use.
#include <gtest/gtest.h>

#include <memory>

#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/once.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(LockMisuseDeathTest, IsReportedWithTheLockItsOwnerTimeTaskSeedAndReplay) {
  EXPECT_DEATH(simulate(
                   [] {
                     mutex m("left");
                     thread holder({.name = "anna"}, [&] {
                       const std::lock_guard guard(m);
                       sleep_for(5ms);
                     });
                     sleep_for(1ms);
                     m.unlock();
                   },
                   order_number(7)),
               "a task unlocks a mutex that it does not hold: mutex #[0-9]+ \"left\", held by anna of environment"
               ".*at virtual time 0.001000000 s, in task main of environment.*seed 7"
               ".*replay: WAITPOINT_SEED=7 ");
}

TEST(LockMisuseDeathTest, TryingToLockWhatOneHolds) {
  const char* message = "a task tries to lock a mutex that it holds: mutex #1, held by main of environment";
  EXPECT_DEATH(simulate([] {
                 mutex m;
                 m.lock();
                 (void)m.try_lock();
               }),
               message);
  for (const auto span : {-1ms, 0ms, 1ms})
    EXPECT_DEATH(simulate([&] {
                   timed_mutex m;
                   const std::lock_guard guard(m);
                   (void)m.try_lock_for(span);
                 }),
                 message);
  EXPECT_DEATH(simulate([] {
                 timed_mutex m;
                 m.lock();
                 (void)m.try_lock_until(steady_clock::time_point::max());
               }),
               message);
}

TEST(LockMisuseDeathTest, EndingAThreadThatHoldsALock) {
  EXPECT_DEATH(simulate([] {
                 mutex other, m("kept");
                 thread({.name = "bert"}, [&] {
                   m.lock();
                   const std::lock_guard guard(other);
                 }).join();
               }),
               "a thread ends while it holds a lock: mutex #[0-9]+ \"kept\", held by bert of environment");
  static mutex kept("kept");
  EXPECT_DEATH(simulate([] { kept.lock(); }), "a thread ends while it holds a lock: mutex #1 \"kept\", held by main");
}

TEST(LockMisuseDeathTest, DestroyingALockThatIsHeld) {
  EXPECT_DEATH(simulate([] { mutex("short").lock(); }),
               "destroyed while it is held: mutex #1 \"short\", held by main of environment");
  EXPECT_DEATH(simulate([] {
                 auto m = std::make_unique<timed_mutex>();
                 thread holder({.name = "anna"}, [&] {
                   m->lock();
                   sleep_for(1h);
                 });
                 thread waiter([&] { m->lock(); });
                 sleep_for(1ms);
                 m.reset();
               }),
               "destroyed while it is held: mutex #[0-9]+, held by anna of environment");
  // Handed over to a task that has not run yet.
  EXPECT_DEATH(simulate([] {
                 auto m = std::make_unique<mutex>();
                 m->lock();
                 thread waiter({.name = "bert"}, [&] { m->lock(); });
                 sleep_for(1ms);
                 m->unlock();
                 m.reset();
               }),
               "destroyed while it is held: mutex #1, held by bert of environment");
}

TEST(LockMisuseDeathTest, DestroyingWhatTasksWaitFor) {
  EXPECT_DEATH(simulate([] {
                 auto c = std::make_unique<condition_variable>("gone");
                 mutex m;
                 thread waiter([&] {
                   std::unique_lock lock(m);
                   c->wait_for(lock, 1h);
                 });
                 sleep_for(1ms);
                 c.reset();
               }),
               "destroyed while tasks wait for it: condition variable #[0-9]+ \"gone\"");
  EXPECT_DEATH(simulate([] {
                 auto s = std::make_unique<counting_semaphore<>>(0);
                 thread waiter([&] { s->acquire(); });
                 sleep_for(1ms);
                 s.reset();
               }),
               "destroyed while tasks wait for it: semaphore #[0-9]+");
  // The waiter has its unit, but has not returned from the call.
  EXPECT_DEATH(simulate([] {
                 auto s = std::make_unique<counting_semaphore<>>(0);
                 thread waiter([&] { s->acquire(); });
                 sleep_for(1ms);
                 s->release();
                 s.reset();
               }),
               "destroyed while tasks wait for it: semaphore #[0-9]+");
}

TEST(LockMisuseDeathTest, DestroyingAtomicsOnceFlagsAndProcessorsThatTasksNeed) {
  EXPECT_DEATH(simulate([] {
                 auto a = std::make_unique<atomic<int>>(0, "gone");
                 thread waiter([&] { a->wait(0); });
                 sleep_for(1ms);
                 a.reset();
               }),
               "destroyed while tasks wait for it: atomic #[0-9]+ \"gone\"");
  EXPECT_DEATH(simulate([] {
                 auto flag = std::make_unique<atomic_flag>();
                 thread waiter([&] { flag->wait(false); });
                 sleep_for(1ms);
                 flag.reset();
               }),
               "destroyed while tasks wait for it: atomic");
  EXPECT_DEATH(simulate([] {
                 auto once = std::make_unique<once_flag>();
                 thread first([&] { call_once(*once, [] { sleep_for(1h); }); });
                 thread second([&] { call_once(*once, [] {}); });
                 sleep_for(1ms);
                 once.reset();
               }),
               "destroyed while it is held: once flag");
  for (const auto started : {0ms, 1ms})
    EXPECT_DEATH(simulate([&] {
                   auto cpu = std::make_unique<processor>("cpu");
                   thread worker({.on = cpu.get()}, [] { sleep_for(1h); });
                   if (started > 0ms) sleep_for(started);
                   cpu.reset();
                 }),
                 "destroyed while threads share it: processor");
}

TEST(LockMisuse, ANullLabelOrNameIsNone) {
  const Report report = simulate([] {
    mutex m(nullptr);
    m.lock();
    thread t({.name = nullptr}, [&] { m.lock(); });
    t.join();
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
}

TEST(LockMisuse, ObjectsOfAnEndedRunCanBeDestroyed) {
  auto held = std::make_unique<mutex>();
  auto waited_for = std::make_unique<counting_semaphore<>>(0);
  {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {}, [&] {
      held->lock();
      thread waiter([&] { waited_for->acquire(); });
      sleep_for(1h);
    });
    EXPECT_EQ(simulation.run_before(Time() + Duration(1ms)), RunEnd::time_reached);
  }
  in_order([&] {
    held.reset();
    waited_for.reset();
  });
}

// Destruction outside all tasks is not part of the run, and no task's mistake.
TEST(LockMisuse, DestructionOutsideTasksIsUnchecked) {
  auto held = std::make_unique<mutex>();
  auto waited_for = std::make_unique<condition_variable>();
  {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {}, [&] {
      std::unique_lock lock(*held);
      waited_for->wait(lock);
    });
    EXPECT_EQ(simulation.run_before(Time() + Duration(1ms)), RunEnd::deadlock);
  }
  held.reset();
  waited_for.reset();
  const counting_semaphore<> never_used(1);
  const timed_mutex never_used_too;
}

TEST(LockMisuseDeathTest, WaitingOnAConditionWithoutHoldingTheMutex) {
  const char* message = "a task waits on a condition variable without holding the lock: condition variable #1 \"c\"";
  EXPECT_DEATH(simulate([] {
                 condition_variable c("c");
                 std::unique_lock<mutex> lock;
                 c.wait(lock);
               }),
               message);
  EXPECT_DEATH(simulate([] {
                 condition_variable c("c");
                 mutex m;
                 std::unique_lock lock(m, std::defer_lock);
                 c.wait(lock);
               }),
               message);
  EXPECT_DEATH(simulate([] {
                 condition_variable c("c");
                 mutex m;
                 std::unique_lock lock(m, std::adopt_lock);  // a false claim
                 c.wait_for(lock, 1ms);
               }),
               message);
}

TEST(LockMisuseDeathTest, WaitingOnOneConditionWithTwoMutexes) {
  EXPECT_DEATH(simulate([] {
                 condition_variable c("both");
                 mutex m[2];
                 thread first([&] {
                   std::unique_lock lock(m[0]);
                   c.wait(lock);
                 });
                 sleep_for(1ms);
                 std::unique_lock lock(m[1]);
                 c.wait(lock);
               }),
               "tasks wait on a condition variable with different mutexes: condition variable #[0-9]+ \"both\"");
}

TEST(LockMisuse, ConditionCanChangeItsMutexWithoutWaiters) {
  in_every_order([] {
    condition_variable c;
    mutex m[2];
    for (mutex& each : m) {
      std::unique_lock lock(each);
      EXPECT_EQ(c.wait_for(lock, 1ms), cv_status::timeout);
    }
  });
}

TEST(LockMisuseDeathTest, SemaphoresThatBeginOutOfTheirRange) {
  const char* message = "a semaphore begins with a count out of its range";
  EXPECT_DEATH(counting_semaphore<>(-1), message);
  EXPECT_DEATH(binary_semaphore(2), message);
  EXPECT_DEATH(simulate([] { counting_semaphore<4>(5).acquire(); }), message);
}

TEST(LockMisuseDeathTest, DurationsThatAreNoNumbers) {
  const std::chrono::duration<double> nan(__builtin_nan(""));
  EXPECT_DEATH(simulate([=] { (void)timed_mutex().try_lock_for(nan); }), "a duration.* is not a number");
  EXPECT_DEATH(simulate([=] {
                 const std::chrono::time_point<steady_clock, std::chrono::duration<double>> never(nan);
                 (void)binary_semaphore(0).try_acquire_until(never);
               }),
               "a time is not a number");
}

}  // namespace
}  // namespace waitpoint
