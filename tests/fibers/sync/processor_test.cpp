// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/processor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <new>
#include <string>
#include <vector>

#include "fibers/sync/priority_mutex.hpp"
#include "tests/fibers/sync/orders.hpp"
#include "tests/fibers/sync/shared_processor.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_until;

TEST(Processor, ComputingTimesDelayEachOtherByPriority) {
  in_every_order([] {
    Shared s;
    for (const auto& [name, priority] : {std::pair("low", 1), std::pair("high", 3), std::pair("middle", 2)})
      s.add(name, priority, [&s, name = std::string(name)] {
        compute(10ms);
        s.log(name);
      });
    s.join();
    EXPECT_EQ(s.trace, "high@10 middle@20 low@30 ");
  });
}

TEST(Processor, TheMoreUrgentPreemptsAndTheRestIsComputedAfterwards) {
  in_every_order([] {
    Shared s;
    s.add("low", 1, [&] {
      compute(4ms);
      compute(16ms);
      s.log("low");
    });
    s.add("high", 2, [&] {
      for (int k = 1; k <= 3; ++k) {
        sleep_until(at(k * 5ms));
        compute(2ms);
        s.log("high");
      }
    });
    s.join();
    EXPECT_EQ(s.trace, "high@7 high@12 high@17 low@26 ");
  });
}

TEST(Processor, AmongEqualsTheFirstGoesOnUntilItWaitsAndAPreemptedOneComesFirst) {
  in_every_order([] {
    Shared s;
    s.add("a", 1, [&] {
      compute(10ms);
      s.log("a");
      this_thread::yield();
      compute(1ms);
      s.log("a");
    });
    s.add("b", 1, [&] {
      sleep_until(at(3ms));
      compute(5ms);
      s.log("b");
    });
    s.add("urgent", 2, [&] {
      sleep_until(at(4ms));
      compute(1ms);
      s.log("urgent");
    });
    s.join();
    EXPECT_EQ(s.trace, "urgent@5 a@11 b@16 a@17 ");
  });
}

TEST(Processor, AWokenThreadMustGetItsProcessorBeforeItGoesOn) {
  in_every_order([] {
    Shared s;
    binary_semaphore ready(0);
    s.add("high", 2, [&] {
      sleep_until(at(1ms));
      compute(10ms);
      s.log("high");
    });
    s.add("low", 1, [&] {
      ready.acquire();
      s.log("low");  // woken at 5
    });
    thread([&] {
      sleep_until(at(5ms));
      ready.release();
    }).join();
    s.join();
    EXPECT_EQ(s.trace, "high@11 low@11 ");
  });
}

TEST(Processor, LatencyOfHardwareAndSleepLeaveItToOthers) {
  in_every_order([] {
    Shared s;
    s.add("high", 2, [&] {
      access_hardware(10ms);
      compute(1ms);
      s.log("high");
    });
    s.add("low", 1, [&] {
      compute(9ms);
      s.log("low");
    });
    s.join();
    EXPECT_EQ(s.trace, "low@9 high@11 ");
  });
}

TEST(Processor, TwoOfThemDoNotDelayEachOther) {
  in_every_order([] {
    Shared one, two;
    one.add("a", 1, [&] {
      compute(10ms);
      one.log("a");
    });
    two.add("b", 1, [&] {
      compute(10ms);
      two.log("b");
    });
    one.join();
    two.join();
    EXPECT_EQ(one.trace + two.trace, "a@10 b@10 ");
  });
}

TEST(Processor, ScaledAndMeasuredCostsAreServedByItToo) {
  in_every_order([] {
    processor cpu;
    thread fast({.clock = {.scale_millionths = 500'000}, .on = &cpu, .priority = 2}, [] { compute(10ms); });
    thread slow({.on = &cpu, .priority = 1}, [] {
      compute(10ms);
      EXPECT_EQ(now(), at(15ms));
    });
    fast.join();
    slow.join();
    thread measured({.clock = {.kind = kernel::ClockKind::cpu}, .on = &cpu}, [] {
      const Time before = now();
      for (int i = 0; i < 10'000; ++i) asm volatile("");
      EXPECT_GT(now(), before);
    });
    measured.join();
  });
}

TEST(Processor, ARunThatEndsBeforeItsThreadsIsUnwound) {
  for (int until_ms = 0; until_ms < 14; ++until_ms) {
    int destroyed = 0;
    {
      processor cpu;
      priority_mutex m;
      Simulation simulation;
      simulation.spawn(simulation.environment(), {}, [&] {
        for (int priority : {1, 2, 3})
          thread({.on = &cpu, .priority = priority}, [&, priority] {
            struct Counter {
              int& count;
              ~Counter() { ++count; }
            } counter{destroyed};
            sleep_until(at(priority * 1ms));
            const std::lock_guard guard(m);
            compute(3ms);
          }).detach();
      });
      simulation.run_before(at(until_ms * 1ms));
      simulation.unwind();
    }
    EXPECT_EQ(destroyed, 3 * (until_ms > 0)) << until_ms;
  }
}

TEST(Processor, MayBeDestroyedAtTheInstantWhenItsLastThreadEnds) {
  in_every_order([] {
    alignas(processor) unsigned char place[sizeof(processor)];
    auto* const cpu = new (place) processor;
    thread({.on = cpu}, [] { compute(1ms); }).join();
    cpu->~processor();
    std::fill(std::begin(place), std::end(place), 0xFF);
    sleep_until(at(2ms));
    EXPECT_EQ(now(), at(2ms));
  });
}

TEST(Processor, MayServeAnotherRunAndWindowsDoNotChangeARun) {
  processor cpu;
  std::string first;
  for (const auto window : {1000ms, 1ms, 3ms}) {
    Simulation simulation;
    simulation.spawn(simulation.environment(), {}, [&] {
      std::vector<thread> threads;
      for (int priority : {1, 2, 3})
        threads.emplace_back(thread_attributes{.on = &cpu, .priority = priority}, [priority] {
          for (int k = 0; k < 5; ++k) {
            this_thread::sleep_for(priority * 3ms);
            compute(priority * 1ms);
          }
        });
      for (thread& t : threads) t.join();
    });
    for (Time until = at(window); simulation.run_before(until) == RunEnd::time_reached; until += Duration(window)) {
    }
    const std::string digest = to_string(simulation.digest());
    EXPECT_TRUE(first.empty() || first == digest);
    first = digest;
  }
}

}  // namespace
}  // namespace waitpoint
