// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "fibers/sync/threads.hpp"
#include "tests/fibers/sync/counted_code.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using kernel::ClockKind;
using kernel::ClockOptions;

// The cost of `body` as a thread with that clock.
Duration cost_with(const ClockOptions& clock, const std::function<void()>& body) {
  Duration cost;
  in_order([&] {
    thread({.clock = clock}, [&] {
      const Time before = now();
      body();
      cost = now() - before;
    }).join();
  });
  return cost;
}

void burn(std::chrono::nanoseconds span) {
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - start < span) {
  }
}

TEST(FixedClock, CostsWhatIsDeclaredTimesItsScale) {
  const auto body = [] {
    compute(3ms);
    compute(1ms, 2ms);
    burn(1ms);
  };
  EXPECT_EQ(cost_with({}, body), Duration(5ms));
  EXPECT_EQ(cost_with({.scale_millionths = 500'000}, body), Duration(2500us));
  EXPECT_EQ(cost_with({.scale_millionths = 2'000'000}, body), Duration(10ms));
  EXPECT_EQ(cost_with({.scale_millionths = 0}, body), Duration());
  EXPECT_EQ(cost_with({.scale_millionths = 333'333}, [] { compute(Duration::from_ns(2)); }).ns(), 1);
}

TEST(IntervalClock, ItsGreatestIsTheWorstCaseInTheDefaultOrder) {
  const auto body = [] {
    compute(3ms);
    compute(5ms);
  };
  const ClockOptions clock{.kind = ClockKind::interval, .least = 100us, .greatest = 300us};
  EXPECT_EQ(cost_with(clock, body), Duration(600us));
  EXPECT_EQ(cost_with({.kind = ClockKind::interval}, body), Duration(8ms));  // as declared
}

TEST(IntervalClock, SeededChoicesFillTheIntervalAndDependOnTheTaskAlone) {
  const ClockOptions clock{.kind = ClockKind::interval, .least = 10us, .greatest = Duration(10us) + 9ns};
  std::set<std::int64_t> seen;
  const auto times_of = [&](std::uint64_t seed, bool with_another) {
    std::vector<std::int64_t> times;
    Simulation simulation({kernel::Order::seeded, seed, ""});
    const auto computing = [&](std::vector<std::int64_t>* into) {
      return [&clock, into] {
        thread({.clock = clock}, [into] {
          for (int i = 0; i < 50; ++i) {
            const Time before = now();
            compute(1s);
            if (into != nullptr) into->push_back((now() - before).ns());
          }
        }).join();
      };
    };
    if (with_another) simulation.spawn(simulation.add_robot("another"), {}, computing(nullptr));
    simulation.spawn(simulation.add_robot("one"), {}, computing(&times));
    EXPECT_EQ(simulation.run_before(), RunEnd::ended);
    return times;
  };
  std::set<std::vector<std::int64_t>> different;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto times = times_of(seed, false);
    EXPECT_EQ(times_of(seed, true), times);
    different.insert(times);
    seen.insert(times.begin(), times.end());
  }
  EXPECT_EQ(different.size(), 20u);
  EXPECT_EQ(seen.size(), 10u);
  EXPECT_EQ(*seen.begin(), 10'000);
  EXPECT_EQ(*seen.rbegin(), 10'009);
}

TEST(IntervalClock, AnyTaskMayDeclareAnInterval) {
  std::set<std::int64_t> seen;
  for (std::uint64_t number = 0; number <= 40; ++number) {
    const Report report = simulate(
        [&] {
          compute(Duration::from_ns(5), Duration::from_ns(8));
          seen.insert(now().ns());
          EXPECT_TRUE(number != 0 || now().ns() == 8);
        },
        order_number(number));
    EXPECT_TRUE(report.passed) << report;
  }
  EXPECT_EQ(seen, (std::set<std::int64_t>{5, 6, 7, 8}));
}

TEST(ProportionalClock, FollowsTheWallClockAndNotWhatIsDeclared) {
  const auto body = [] {
    compute(100s);
    burn(3ms);
  };
  const auto least_of = [](const auto& measure) {  // the least of several: the machine may be busy
    Duration least = Duration::max();
    for (int i = 0; i < 5; ++i) least = std::min(least, measure());
    return least;
  };
  const auto cost = [&](const ClockOptions& clock) { return least_of([&] { return cost_with(clock, body); }); };
  const Duration plain = cost({.kind = ClockKind::proportional});
  EXPECT_GE(plain, Duration(3ms));
  EXPECT_LT(plain, Duration(30ms));
  const Duration tenfold = cost({.kind = ClockKind::proportional, .scale_millionths = 10'000'000});
  EXPECT_GE(tenfold, Duration(30ms));
  EXPECT_LT(tenfold, Duration(300ms));
}

TEST(CpuClock, DoesNotCountWaitingForTheMachine) {
  Duration computed, slept = Duration::max();
  in_order([&] {
    thread({.clock = {.kind = ClockKind::cpu}}, [&] {
      const Time start = now();
      for (int i = 0; i < 1'000'000; ++i) asm volatile("");
      computed = now() - start;
      for (int i = 0; i < 5; ++i) {
        const Time before = now();
        const timespec nap{0, 5'000'000};
        nanosleep(&nap, nullptr);
        slept = std::min(slept, now() - before);
      }
    }).join();
  });
  EXPECT_GT(computed, Duration(100us));
  EXPECT_LT(slept, Duration(4ms));
}

TEST(MeasuredClocks, TimeOfOtherTasksDoesNotCount) {
  Duration own;
  in_order([&] {
    thread other([] {
      for (int i = 0; i < 3; ++i) {
        burn(20ms);
        this_thread::yield();
      }
    });
    thread({.clock = {.kind = ClockKind::cpu}}, [&] {
      for (int i = 0; i < 3; ++i) this_thread::yield();
      own = now() - Time();
    }).join();
    other.join();
  });
  EXPECT_LT(own, Duration(15ms));
}

TEST(CountedClock, CostsADeclaredTimeForEachBasicBlockTheSameInEveryRun) {
  const auto cost = [](unsigned long n, Duration block, std::int64_t scale) {
    Duration cost;
    in_every_order([&] {
      thread({.clock = {.kind = ClockKind::counted, .scale_millionths = scale, .block_cost = block}}, [&] {
        compute(1s);  // ignored: the blocks are counted
        const Time before = now();
        collatz_steps(n);
        const Duration here = now() - before;
        EXPECT_TRUE(cost == Duration() || here == cost);
        cost = here;
      }).join();
    });
    return cost;
  };
  const Duration of_27 = cost(27, 10ns, 1'000'000);  // 111 steps
  const Duration of_28 = cost(28, 10ns, 1'000'000);  // 18 steps
  EXPECT_GT(of_28, Duration(180ns));
  EXPECT_GT(of_27, of_28 * 5);
  EXPECT_LT(of_27, of_28 * 7);
  EXPECT_EQ(of_27.ns() % 10, 0);
  EXPECT_EQ(cost(27, 30ns, 1'000'000), of_27 * 3);
  EXPECT_EQ(cost(27, 10ns, 500'000), of_27 / 2);
}

TEST(CountedClock, CodeThatIsNotInstrumentedPassesNoBlocks) {
  const std::uint64_t before = kernel::turn.blocks;
  std::vector<int> values(1000);
  for (int& value : values) value = value * 2 + 1;
  EXPECT_EQ(kernel::turn.blocks, before);
  collatz_steps(27);
  EXPECT_GT(kernel::turn.blocks, before + 111);
}

TEST(LocalClocks, AreNotInheritedAndEndWithTheirThread) {
  in_every_order([] {
    thread({.clock = {.scale_millionths = 2'000'000}}, [] {
      compute(1ms);
      EXPECT_EQ(now(), at(2ms));
      thread child([] {
        compute(1ms);
        EXPECT_EQ(now(), at(3ms));
      });
      child.join();
      thread({.clock = {.kind = ClockKind::cpu}}, [] {}).detach();
    }).join();
  });
}

TEST(LocalClocksDeathTest, SwappedNegativeAndOverflowingCostsAreBugs) {
  const auto dies = [](const char* message, const std::function<void()>& body) {
    EXPECT_DEATH(simulate(body), message);
  };
  dies("swapped", [] { compute(2ms, 1ms); });
  dies("negative", [] { compute(Duration(-1ms)); });
  dies("negative", [] { compute(Duration(-1ms), 1ms); });
  dies("swapped",
       [] { thread({.clock = {.kind = ClockKind::interval, .least = 2ms, .greatest = 1ms}}, [] {}).join(); });
  dies("negative", [] { thread({.clock = {.scale_millionths = -1}}, [] {}).join(); });
  dies("overflows",
       [] { thread({.clock = {.scale_millionths = 9'000'000}}, [] { compute(Duration::max()); }).join(); });
}

}  // namespace
}  // namespace waitpoint
