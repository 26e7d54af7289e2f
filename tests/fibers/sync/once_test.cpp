// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/once.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(CallOnce, OneCallsAndTheOthersWaitForItsReturn) {
  std::set<int> callers;
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    const Report report = simulate(
        [&] {
          once_flag flag;
          int calls = 0;
          bool done = false;
          std::vector<thread> all;
          for (int i = 0; i < 4; ++i)
            all.emplace_back([&, i] {
              call_once(flag, [&] {
                ++calls;
                callers.insert(i);
                sleep_for(3ms);
                done = true;
              });
              EXPECT_TRUE(done);
              EXPECT_EQ(now(), at(3ms));
            });
          for (thread& t : all) t.join();
          call_once(flag, [&] { ++calls; });
          EXPECT_EQ(calls, 1);
          EXPECT_EQ(now(), at(3ms));
        },
        order_number(number));
    ASSERT_TRUE(report.passed) << report;
  }
  EXPECT_EQ(callers.size(), 4u);
}

TEST(CallOnce, PassesArgumentsOn) {
  in_order([] {
    once_flag flag;
    int sum = 0;
    call_once(
        flag, [&](int a, std::unique_ptr<int> b) { sum = a + *b; }, 2, std::make_unique<int>(40));
    EXPECT_EQ(sum, 42);
  });
}

TEST(CallOnce, AnotherWaiterCallsAfterAnException) {
  in_every_order([] {
    once_flag flag("camera");
    int calls = 0, caught = 0;
    std::vector<thread> all;
    for (int i = 0; i < 4; ++i)
      all.emplace_back([&] {
        try {
          call_once(flag, [&] {
            sleep_for(2ms);
            if (++calls < 3) throw std::runtime_error("not yet");
          });
          EXPECT_EQ(calls, 3);
        } catch (const std::runtime_error&) {
          ++caught;
        }
      });
    for (thread& t : all) t.join();
    EXPECT_EQ(calls, 3);
    EXPECT_EQ(caught, 2);
    EXPECT_EQ(now(), at(6ms));
  });
}

TEST(CallOnce, CallingItselfIsADeadlockThatIsNamed) {
  const Report report = simulate([] {
    once_flag flag("map");
    call_once(flag, [&] { call_once(flag, [] {}); });
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_NE(report.text.find("a task waits for itself"), std::string::npos) << report;
  EXPECT_NE(report.text.find("waits (call_once) for once flag #1 \"map\""), std::string::npos) << report;
}

TEST(CallOnce, TwoFlagsThatCallEachOtherAreADeadlock) {
  const Report report = simulate([] {
    once_flag a, b;
    thread other([&] {
      call_once(b, [&] {
        sleep_for(1ms);
        call_once(a, [] {});
      });
    });
    call_once(a, [&] {
      sleep_for(1ms);
      call_once(b, [] {});
    });
    other.join();
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_NE(report.text.find("2 tasks wait for each other"), std::string::npos) << report;
}

TEST(CallOnce, AFlagThatARunLeavesBehindReadsAsFresh) {
  static once_flag flag;
  int calls = 0;
  for (int run = 0; run < 2; ++run) {
    in_order([&] { call_once(flag, [&] { ++calls; }); });
    EXPECT_EQ(calls, 2 * run + 1);
    // A flag that a run leaves during its call:
    const Report report = simulate([&] {
      thread({.name = "calls", .service = true}, [&] { call_once(flag, [] { sleep_for(1h); }); }).detach();
      sleep_for(1ms);
    });
    EXPECT_TRUE(report.passed && report.abandoned.empty()) << report;
    ++calls;
  }
}

TEST(CallOnceDeathTest, UseOutsideAnyTask) {
  once_flag flag;
  EXPECT_DEATH(call_once(flag, [] {}), "a simulated primitive is used outside a simulated task");
}

}  // namespace
}  // namespace waitpoint
