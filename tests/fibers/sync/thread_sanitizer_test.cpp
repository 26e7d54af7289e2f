// SPDX-License-Identifier: BSD-3-Clause
// In a program built with ThreadSanitizer: accesses of two tasks to the same memory without synchronisation by a
// primitive are a data race, though all tasks run in one thread of the system; synchronised accesses are not.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/periodic_timer.hpp"
#include "fibers/sync/semaphore.hpp"
#include "fibers/sync/simulation.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// Each test runs in a re-executed program, with reports enabled and without the state of earlier tests.
class ThreadSanitizerDeathTest : public testing::Test {
 protected:
  ThreadSanitizerDeathTest() {
    const char* options = std::getenv("TSAN_OPTIONS");
    if (options != nullptr) before_ = options;
    setenv("TSAN_OPTIONS", (before_.value_or("") + ":report_bugs=1").c_str(), 1);
    testing::FLAGS_gtest_death_test_style = "threadsafe";
  }
  ~ThreadSanitizerDeathTest() override {
    before_ ? setenv("TSAN_OPTIONS", before_->c_str(), 1) : unsetenv("TSAN_OPTIONS");
    testing::FLAGS_gtest_death_test_style = style_;
  }

 private:
  std::optional<std::string> before_;
  std::string style_ = testing::FLAGS_gtest_death_test_style;
};

[[noreturn]] void simulate_and_exit(const std::function<void()>& body) { std::exit(simulate(body).passed ? 0 : 1); }

void expect_race(const std::function<void()>& body) {
  // ThreadSanitizer's own exit status after a report.
  EXPECT_EXIT(simulate_and_exit(body), testing::ExitedWithCode(66), "data race");
}

void expect_none(const std::function<void()>& body) {
  EXPECT_EXIT(simulate_and_exit(body), testing::ExitedWithCode(0), "");
}

// --- races ---

TEST_F(ThreadSanitizerDeathTest, TasksThatOnlySleepRace) {
  expect_race([] {
    int shared = 0;
    thread other([&] { ++shared; });
    this_thread::sleep_for(1ms);
    ++shared;
    other.join();
  });
}

TEST_F(ThreadSanitizerDeathTest, TasksThatOnlyYieldRace) {
  expect_race([] {
    int shared = 0;
    thread other([&] { ++shared; });
    this_thread::yield();
    ++shared;
    other.join();
  });
}

TEST_F(ThreadSanitizerDeathTest, AccessAfterTheUnlockRaces) {
  expect_race([] {
    mutex m;
    int shared = 0;
    thread other([&] {
      m.lock();
      m.unlock();
      ++shared;
    });
    this_thread::sleep_for(1ms);
    m.lock();
    ++shared;
    m.unlock();
    other.join();
  });
}

TEST_F(ThreadSanitizerDeathTest, DifferentMutexesDoNotOrder) {
  expect_race([] {
    mutex m, n;
    int shared = 0;
    thread other([&] {
      const std::lock_guard guard(m);
      ++shared;
    });
    this_thread::sleep_for(1ms);
    {
      const std::lock_guard guard(n);
      ++shared;
    }
    other.join();
  });
}

TEST_F(ThreadSanitizerDeathTest, TasksThatShareATimersPeriodRace) {
  expect_race([] {
    int shared = 0;
    const auto count = [&] {
      periodic_timer timer(Period::every(1ms));
      timer.wait();
      ++shared;
    };
    thread other(count);
    count();
    other.join();
  });
}

// --- no races ---

TEST_F(ThreadSanitizerDeathTest, AMutexOrders) {
  expect_none([] {
    mutex m;
    int shared = 0;
    const auto count = [&] {
      for (int i = 0; i < 10; ++i) {
        const std::lock_guard guard(m);
        ++shared;
        this_thread::sleep_for(1ms);
      }
    };
    thread one(count), two(count);
    one.join();
    two.join();
    EXPECT_EQ(shared, 20);
  });
}

TEST_F(ThreadSanitizerDeathTest, AConditionVariableAndItsMutexOrder) {
  expect_none([] {
    mutex m;
    condition_variable changed;
    int shared = 0;
    bool ready = false;
    thread other([&] {
      std::unique_lock lock(m);
      while (!ready) changed.wait_for(lock, 2ms);
      ++shared;
    });
    this_thread::sleep_for(1ms);
    ++shared;  // no other task does before it is ready
    {
      const std::lock_guard guard(m);
      ready = true;
      changed.notify_one();
    }
    other.join();
    EXPECT_EQ(shared, 2);
  });
}

TEST_F(ThreadSanitizerDeathTest, ASemaphoreOrders) {
  expect_none([] {
    binary_semaphore given(0), taken(0);
    int shared = 0;
    thread other([&] {
      for (int i = 0; i < 5; ++i) {
        given.acquire();
        ++shared;
        taken.release();
      }
    });
    for (int i = 0; i < 5; ++i) {
      ++shared;
      given.release();
      taken.acquire();
    }
    other.join();
    EXPECT_EQ(shared, 10);
  });
}

TEST_F(ThreadSanitizerDeathTest, MakingAndJoiningOrder) {
  expect_none([] {
    for (int round = 0; round < 20; ++round) {  // on the same stack repeatedly
      int shared = round;
      thread other([&] {
        ++shared;
        this_thread::sleep_for(1us);
      });
      other.join();
      EXPECT_EQ(shared, round + 1);
    }
  });
}

TEST_F(ThreadSanitizerDeathTest, TheContextOutsideIsOrderedWithAllTasks) {
  expect_none([] {});
  const auto windows = [] {
    int shared[2] = {};
    Simulation simulation;
    for (int& of_task : shared)
      simulation.spawn(simulation.environment(), {}, [&of_task] {
        for (int i = 0; i < 3; ++i) {
          ++of_task;
          this_thread::sleep_for(1us);
        }
      });
    for (int window = 1; window < 4; ++window) {
      simulation.run_before(Time::from_ns(1000 * window));
      for (int& of_task : shared) ++of_task;
    }
    simulation.run_before();
    std::exit(shared[0] == 6 && shared[1] == 6 ? 0 : 1);
  };
  EXPECT_EXIT(windows(), testing::ExitedWithCode(0), "");
}

TEST_F(ThreadSanitizerDeathTest, ExceptionsAndUnwindingAreNoRaces) {
  expect_none([] {
    for (int round = 0; round < 3; ++round) {
      thread other([] {
        try {
          this_thread::sleep_for(1us);
          throw 1;
        } catch (int) {
          this_thread::sleep_for(1us);
        }
      });
      other.join();
    }
    thread([] { this_thread::sleep_for(1h); }).detach();
    thread({.name = "service", .service = true}, [] {
      for (;;) this_thread::sleep_for(1s);
    }).detach();
  });
}

}  // namespace
}  // namespace waitpoint
