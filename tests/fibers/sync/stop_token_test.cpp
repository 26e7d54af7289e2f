// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/stop_token.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/leaks.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(StopToken, SeesWhatItsSourceWasAsked) {
  in_every_order([] {
    stop_source source;
    const stop_token token = source.get_token();
    EXPECT_TRUE(token.stop_possible());
    EXPECT_FALSE(token.stop_requested());
    EXPECT_TRUE(source.request_stop());
    EXPECT_FALSE(source.request_stop());
    EXPECT_TRUE(token.stop_requested());
    EXPECT_TRUE(source.stop_requested());
    EXPECT_EQ(now(), Time());
  });
}

TEST(StopToken, CopiesShareOneStateAndOthersDoNot) {
  in_order([] {
    stop_source one, other;
    stop_source copy = one;
    EXPECT_EQ(one, copy);
    EXPECT_NE(one, other);
    EXPECT_EQ(one.get_token(), copy.get_token());
    EXPECT_NE(one.get_token(), stop_token());
    copy.request_stop();
    EXPECT_TRUE(one.stop_requested());
    EXPECT_FALSE(other.stop_requested());
    swap(one, other);
    EXPECT_TRUE(other.stop_requested());
    copy = other;
    EXPECT_TRUE(copy.stop_requested());
  });
}

TEST(StopToken, WithoutAStateOrASourceStopIsImpossible) {
  in_order([] {
    EXPECT_FALSE(stop_token().stop_possible());
    EXPECT_FALSE(stop_token().stop_requested());
    stop_source none(nostopstate);
    EXPECT_FALSE(none.stop_possible());
    EXPECT_FALSE(none.request_stop());
    std::optional<stop_source> source(std::in_place);
    std::optional<stop_source> copy(*source);
    const stop_token orphan = source->get_token();
    source.reset();
    EXPECT_TRUE(orphan.stop_possible());
    copy.reset();
    EXPECT_FALSE(orphan.stop_possible());
    bool called = false;
    stop_callback callback(orphan, [&] { called = true; });
    EXPECT_FALSE(called);
    stop_source asked;
    asked.request_stop();
    const stop_token token = std::exchange(asked, stop_source(nostopstate)).get_token();
    EXPECT_TRUE(token.stop_possible());  // because it has been requested
  });
}

TEST(StopToken, RequesterRunsCallbacksInTheirOrderOfRegistration) {
  in_every_order([] {
    stop_source source;
    std::string order;
    thread::id caller;
    stop_callback a(source.get_token(), [&] { order += 'a'; });
    std::optional<stop_callback<std::function<void()>>> gone(std::in_place, source.get_token(), [&] { order += 'x'; });
    stop_callback b(source.get_token(), [&] {
      order += 'b';
      caller = this_thread::get_id();
    });
    gone.reset();
    thread asks([&] {
      sleep_for(2ms);
      EXPECT_TRUE(source.request_stop());
      EXPECT_EQ(order, "ab");
      EXPECT_EQ(caller, this_thread::get_id());
    });
    EXPECT_EQ(order, "");
    asks.join();
    stop_callback late(source.get_token(), [&] { order += 'c'; });
    EXPECT_EQ(order, "abc");
    EXPECT_FALSE(source.request_stop());
    EXPECT_EQ(order, "abc");
  });
}

TEST(StopToken, OneOfSeveralThatAskIsTheFirstAndCallsOnce) {
  std::set<int> firsts;
  for (std::uint64_t number = 0; number <= seeds_tried; ++number) {
    const Report report = simulate(
        [&] {
          stop_source source;
          int calls = 0, granted = 0;
          stop_callback callback(source.get_token(), [&] { ++calls; });
          std::vector<thread> all;
          for (int i = 0; i < 4; ++i)
            all.emplace_back([&, i] {
              if (!source.request_stop()) return;
              ++granted;
              firsts.insert(i);
            });
          for (thread& t : all) t.join();
          EXPECT_EQ(calls, 1);
          EXPECT_EQ(granted, 1);
        },
        order_number(number));
    ASSERT_TRUE(report.passed) << report;
  }
  EXPECT_EQ(firsts.size(), 4u);  // the operations are waitpoints: a schedule can put any of them first
}

TEST(StopToken, DestroyingACallbackWaitsForTheTaskThatCallsIt) {
  in_every_order([] {
    stop_source source;
    bool left = false;
    auto callback = [&] {
      sleep_for(5ms);
      compute(1ms);
      left = true;
    };
    std::optional<stop_callback<decltype(callback)>> registered(std::in_place, source.get_token(), callback);
    thread asks([&] { source.request_stop(); });
    sleep_for(2ms);
    EXPECT_FALSE(left);
    registered.reset();
    EXPECT_TRUE(left);
    EXPECT_EQ(now(), at(6ms));
    asks.join();
  });
}

TEST(StopToken, DestroyingACallbackWaitsForNoOtherOne) {
  in_every_order([] {
    stop_source source;
    bool called = false;
    stop_callback slow(source.get_token(), [] { sleep_for(5ms); });
    auto never = [&] { called = true; };
    std::optional<stop_callback<decltype(never)>> other(std::in_place, source.get_token(), never);
    thread asks([&] { source.request_stop(); });
    sleep_for(2ms);
    other.reset();
    EXPECT_EQ(now(), at(2ms));
    asks.join();
    EXPECT_FALSE(called);
  });
}

TEST(StopToken, ACallbackMayDestroyItselfAndItsSource) {
  in_every_order([] {
    std::optional<stop_source> source(std::in_place);
    std::optional<stop_callback<std::function<void()>>> callback;
    int calls = 0;
    callback.emplace(source->get_token(), [&] {
      callback.reset();
      ++calls;
    });
    stop_callback second(source->get_token(), [&] { source.reset(); });
    stop_callback third(source->get_token(), [&] { ++calls; });
    source->request_stop();
    EXPECT_EQ(calls, 2);
  });
}

TEST(StopToken, ACallbackWhoseEndTwoTasksAwaitFromEachOtherIsADeadlock) {
  const LeaksOnPurpose leaks;
  const Report report = simulate([] {
    stop_source source;
    std::optional<stop_callback<std::function<void()>>> callback;
    std::optional<thread> destroys;
    callback.emplace(source.get_token(), [&] {
      destroys.emplace([&] { callback.reset(); });
      sleep_for(1ms);
      destroys->join();
    });
    source.request_stop();
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_NE(report.text.find("2 tasks wait for each other"), std::string::npos) << report;
  EXPECT_NE(report.text.find("for stop state"), std::string::npos) << report;
}

TEST(StopToken, EndlessPollingIsNoProgress) {
  const Report report = simulate([] {
    const stop_source source;
    while (!source.stop_requested()) {
    }
  });
  EXPECT_EQ(report.end, RunEnd::no_progress);
  EXPECT_TRUE(report.abandoned.empty());
}

TEST(StopToken, AStateThatARunLeavesBehindReadsAsFresh) {
  stop_source source;
  for (int run = 0; run < 2; ++run)
    in_order([&] {
      int calls = 0;
      EXPECT_FALSE(source.stop_requested());
      stop_callback callback(source.get_token(), [&] { ++calls; });
      EXPECT_TRUE(source.request_stop());
      EXPECT_EQ(calls, 1);
    });
}

TEST(StopToken, ARunThatEndsWithinACallbackIsUnwound) {
  const Report report = simulate([] {
    stop_source source;
    stop_callback callback(source.get_token(), [] { sleep_for(1h); });
    thread({.name = "asks", .service = true}, [&] { source.request_stop(); }).detach();
    thread({.name = "destroys", .service = true}, [&] {
      sleep_for(1ms);
      stop_callback other(source.get_token(), [] { sleep_for(1h); });
    }).detach();
    sleep_for(1s);
  });
  // The main task's own callback is running when the task ends: the task waits for it, as in the standard.
  EXPECT_TRUE(report.passed) << report;
  EXPECT_EQ(report.end_time, at(1h));
}

TEST(StopToken, ATaskThatDestroysWhatAnotherCallsWhenTheRunEndsIsNamed) {
  const LeaksOnPurpose leaks;
  auto source = std::make_shared<stop_source>();
  const Report report = simulate([&] {
    thread({.name = "destroys", .service = true}, [&] {
      stop_callback callback(source->get_token(), [] { sleep_for(1h); });
      sleep_for(2ms);
    }).detach();
    thread({.name = "asks", .service = true}, [&] {
      sleep_for(1ms);
      source->request_stop();
    }).detach();
    sleep_for(1s);
  });
  EXPECT_TRUE(report.passed) << report;
  // The younger task's callback was unwound first.
  EXPECT_EQ(report.abandoned, std::vector<std::string>{"destroys of environment"});
}

TEST(StopTokenDeathTest, AnExceptionOutOfACallbackEndsTheProgram) {
  EXPECT_EXIT(simulate([] {
                stop_source source;
                stop_callback callback(source.get_token(), [] { throw 1; });
                source.request_stop();
              }),
              testing::KilledBySignal(SIGABRT), "");
}

TEST(StopTokenDeathTest, UseOutsideAnyTask) {
  const char* message = "a simulated primitive is used outside a simulated task";
  EXPECT_DEATH(stop_source().request_stop(), message);
  EXPECT_DEATH((void)stop_source().get_token().stop_requested(), message);
}

}  // namespace
}  // namespace waitpoint
