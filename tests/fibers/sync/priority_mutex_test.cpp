// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/priority_mutex.hpp"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <vector>

#include "tests/fibers/sync/orders.hpp"
#include "tests/fibers/sync/shared_processor.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using kernel::LockProtocol;
using this_thread::sleep_until;

// Priority inversion, as on Mars Pathfinder: a middle thread delays the high one as long as it computes.

template <class Mutex>
std::string inversion(Mutex& m) {
  std::string trace;
  in_every_order([&] {
    Shared s;
    s.add("low", 1, [&] {
      const std::lock_guard guard(m);
      compute(4ms);
      s.log("low");
    });
    s.add("middle", 2, [&] {
      sleep_until(at(2ms));
      compute(100ms);
      s.log("middle");
    });
    s.add("high", 3, [&] {
      sleep_until(at(1ms));
      const std::lock_guard guard(m);
      compute(1ms);
      s.log("high");
    });
    s.join();
    EXPECT_TRUE(trace.empty() || trace == s.trace);
    trace = s.trace;
  });
  return trace;
}

TEST(PriorityInversion, AppearsWithAPlainMutex) {
  mutex plain;
  EXPECT_EQ(inversion(plain), "middle@102 low@104 high@105 ");
}

TEST(PriorityInversion, IsBoundedByInheritanceAndCeiling) {
  priority_mutex inheriting, with_ceiling({.protocol = LockProtocol::ceiling, .ceiling = 3});
  EXPECT_EQ(inversion(inheriting), "low@4 high@5 middle@105 ");
  EXPECT_EQ(inversion(with_ceiling), "low@4 high@5 middle@105 ");
}

TEST(PriorityMutex, InheritanceGoesThroughChains) {
  in_every_order([] {
    Shared s;
    priority_mutex a, b;
    s.add("low", 1, [&] {
      const std::lock_guard guard(a);
      compute(5ms);
    });
    s.add("next", 2, [&] {
      sleep_until(at(1ms));
      const std::lock_guard outer(b);
      const std::lock_guard inner(a);
      compute(5ms);
      s.log("next");
    });
    s.add("middle", 3, [&] {
      sleep_until(at(3ms));
      compute(50ms);
      s.log("middle");
    });
    s.add("high", 4, [&] {
      sleep_until(at(2ms));
      const std::lock_guard guard(b);
      s.log("high");
    });
    s.join();
    EXPECT_EQ(s.trace, "next@10 high@10 middle@60 ");
  });
}

TEST(PriorityMutex, ATimeoutTakesBackWhatWasInherited) {
  in_every_order([] {
    Shared s;
    priority_mutex m;
    s.add("low", 1, [&] {
      const std::lock_guard guard(m);
      compute(20ms);
      s.log("low");
    });
    s.add("middle", 2, [&] {
      sleep_until(at(2ms));
      compute(10ms);
      s.log("middle");
    });
    s.add("high", 3, [&] {
      sleep_until(at(1ms));
      EXPECT_FALSE(m.try_lock_for(4ms));
      s.log("high");
      EXPECT_FALSE(m.try_lock());
      EXPECT_FALSE(m.try_lock_for(0ms));
      EXPECT_FALSE(m.try_lock_until(steady_clock::now()));
      compute(1ms);
    });
    s.join();
    // low has computed 5 ms when the timeout expires; high takes 1, middle 10, low the rest.
    EXPECT_EQ(s.trace, "high@5 middle@16 low@31 ");
  });
}

TEST(PriorityMutex, ServesTheMostUrgentAndOfEqualsTheFirst) {
  in_every_order([] {
    Shared s;
    priority_mutex m;
    s.add("holder", 9, [&] {
      const std::lock_guard guard(m);
      sleep_until(at(10ms));
    });
    for (const auto& [name, priority, start] :
         {std::tuple("a", 1, 1ms), std::tuple("b", 2, 2ms), std::tuple("c", 2, 3ms), std::tuple("d", 1, 4ms)})
      s.add(name, priority, [&s, &m, name = std::string(name), start = start] {
        sleep_until(at(start));
        const std::lock_guard guard(m);
        compute(1ms);
        s.log(name);
      });
    s.join();
    EXPECT_EQ(s.trace, "b@11 c@12 a@13 d@14 ");
  });
}

TEST(PriorityMutex, WithoutAProcessorItIsAMutex) {
  in_every_order([] {
    priority_mutex m;
    int inside = 0;
    std::vector<thread> threads;
    for (int i = 0; i < 4; ++i)
      threads.emplace_back([&] {
        for (int k = 0; k < 5; ++k) {
          const std::lock_guard guard(m);
          EXPECT_EQ(++inside, 1);
          this_thread::sleep_for(1ms);
          --inside;
        }
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(now(), at(20ms));
  });
}

TEST(PriorityMutex, DeadlocksAreReported) {
  const Report report = simulate([] {
    priority_mutex a({.label = "a"}), b({.label = "b"});
    Shared s;
    s.add("one", 1, [&] {
      const std::lock_guard outer(a);
      this_thread::sleep_for(1ms);
      const std::lock_guard inner(b);
    });
    s.add("two", 2, [&] {
      const std::lock_guard outer(b);
      this_thread::sleep_for(1ms);
      const std::lock_guard inner(a);
    });
    s.join();
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_NE(report.text.find("\"a\", held by one"), std::string::npos) << report;
}

TEST(PriorityMutexDeathTest, MisuseIsABug) {
  EXPECT_DEATH(simulate([] {
                 priority_mutex m({.protocol = LockProtocol::ceiling, .ceiling = 1});
                 Shared s;
                 s.add("urgent", 2, [&] { m.lock(); });
                 s.join();
               }),
               "priority ceiling is below");
  EXPECT_DEATH(simulate([] { priority_mutex("mine").unlock(); }),
               "a task unlocks a mutex that it does not hold: mutex #1 \"mine\"");
  EXPECT_DEATH(simulate([] {
                 priority_mutex m;
                 m.lock(), (void)m.try_lock();
               }),
               "a task tries to lock a mutex that it holds: mutex #1, held by main of environment");
  EXPECT_DEATH(simulate([] { priority_mutex("short").lock(); }), "destroyed while it is held: mutex #1 \"short\"");
  static priority_mutex kept("kept");
  EXPECT_DEATH(simulate([] { kept.lock(); }), "a thread ends while it holds a lock: mutex #1 \"kept\", held by main");
}

}  // namespace
}  // namespace waitpoint
