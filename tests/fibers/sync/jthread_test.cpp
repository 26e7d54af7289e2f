// SPDX-License-Identifier: BSD-3-Clause
// jthread, and the functions of thread other than start and join.
#include "fibers/sync/jthread.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <sstream>
#include <unordered_set>
#include <vector>

#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(JThread, IsAskedToStopAndJoinedByItsDestructor) {
  in_every_order([] {
    int rounds = 0;
    {
      const jthread worker(
          [&](const stop_token& stop, int step) {
            while (!stop.stop_requested()) {
              sleep_for(2ms);
              rounds += step;
            }
          },
          10);
      EXPECT_TRUE(worker.joinable());
      sleep_for(5ms);
    }
    EXPECT_EQ(rounds, 30);
    EXPECT_EQ(now(), at(6ms));
  });
}

TEST(JThread, AFunctionThatTakesNoTokenIsJoinedOnly) {
  in_every_order([] {
    {
      const jthread worker(
          {.name = "worker"}, [](int ms) { sleep_for(std::chrono::milliseconds(ms)); }, 4);
    }
    EXPECT_EQ(now(), at(4ms));
  });
}

TEST(JThread, AssigningStopsAndJoinsWhatWasThere) {
  in_every_order([] {
    jthread worker([](const stop_token& stop) {
      while (!stop.stop_requested()) sleep_for(2ms);
    });
    sleep_for(3ms);
    worker = jthread([] { sleep_for(10ms); });
    EXPECT_EQ(now(), at(4ms));
    EXPECT_FALSE(worker.get_stop_token().stop_requested());
    EXPECT_TRUE(worker.request_stop());
    EXPECT_TRUE(worker.get_stop_source().stop_requested());
    EXPECT_FALSE(worker.try_join_for(1ms));
    worker.join();
    EXPECT_EQ(now(), at(13ms));
    EXPECT_FALSE(worker.joinable());
    EXPECT_FALSE(jthread().get_stop_token().stop_possible());
  });
}

TEST(JThread, ARunThatEndsLetsThemGo) {
  const Report report = simulate([] {
    thread({.name = "service", .service = true}, [] {
      const jthread inner({.name = "inner", .service = true}, [] { sleep_for(1h); });
      const jthread second({.name = "second", .service = true}, [](const stop_token& stop) {
        while (!stop.stop_requested()) sleep_for(1ms);
      });
    }).detach();
    sleep_for(1s);
  });
  EXPECT_TRUE(report.passed && report.abandoned.empty()) << report;
  EXPECT_EQ(report.end_time, at(1s));
}

TEST(Thread, ATimedJoinEndsWhenTheThreadOrTheTimeDoes) {
  in_every_order([] {
    thread t([] { sleep_for(5ms); });
    EXPECT_FALSE(t.try_join_for(0s));
    EXPECT_FALSE(t.try_join_for(-1s));
    EXPECT_EQ(now(), Time());
    EXPECT_FALSE(t.try_join_for(2ms));
    EXPECT_EQ(now(), at(2ms));
    EXPECT_FALSE(t.try_join_until(steady_clock::time_point(1ms)));
    EXPECT_TRUE(t.joinable());
    EXPECT_TRUE(t.try_join_until(system_clock::now() + 1h));
    EXPECT_EQ(now(), at(5ms));
    EXPECT_FALSE(t.joinable());
    thread ended([] {});
    sleep_for(1ms);
    EXPECT_TRUE(ended.try_join_for(0s));
  });
}

TEST(Thread, AJoinThatTimesOutAtTheEndOfTheThreadCanHaveItEitherWay) {
  expect_both([] {
    thread t([] { sleep_for(5ms); });
    const bool in_time = t.try_join_for(5ms);
    EXPECT_EQ(t.joinable(), !in_time);
    if (t.joinable()) t.join();
    EXPECT_EQ(now(), at(5ms));
    return in_time;
  });
}

TEST(Thread, JoiningOneselfIsADeadlockOfOne) {
  const Report report = simulate([] {
    std::optional<thread> self;
    self.emplace([&] {
      sleep_for(1ms);
      self->join();
    });
    sleep_for(1h);
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_EQ(report.end_time, at(1ms));
  EXPECT_NE(report.text.find("a task waits for itself"), std::string::npos) << report;
  EXPECT_NE(report.text.find("waits (join) for end of thread"), std::string::npos) << report;
}

TEST(Thread, IdsCanBeShownHashedAndOrderedAlikeInEveryRun) {
  std::string first;
  for (int run = 0; run < 2; ++run)
    in_order([&] {
      std::ostringstream text;
      thread a([] {}), b([] {});
      text << a.get_id() << ' ' << b.get_id() << ' ' << thread::id();
      EXPECT_NE(text.str().find("no thread"), std::string::npos);
      const std::unordered_set<thread::id> ids = {a.get_id(), b.get_id(), a.get_id(), thread::id()};
      EXPECT_EQ(ids.size(), 3u);
      EXPECT_NE(a.get_id() < b.get_id(), b.get_id() < a.get_id());
      a.join();
      b.join();
      if (run == 0) first = text.str();
      EXPECT_EQ(text.str(), first);
    });
}

TEST(Thread, TheNumberOfProcessorsIsADeclaredOne) {
  EXPECT_EQ(thread::hardware_concurrency(), 0u);
  in_order([] { EXPECT_EQ(thread::hardware_concurrency(), 4u); });
  SimulationOptions options;
  options.hardware_concurrency = 1;
  EXPECT_TRUE(simulate([] { EXPECT_EQ(jthread::hardware_concurrency(), 1u); }, options).passed);
}

TEST(Thread, ItsNativeHandleIsTheKernelsRecordWhileItRuns) {
  in_order([] {
    thread t({.name = "worker"}, [] { sleep_for(1ms); });
    ASSERT_NE(t.native_handle(), nullptr);
    EXPECT_STREQ(t.native_handle()->name, "worker");
    sleep_for(2ms);
    EXPECT_EQ(t.native_handle(), nullptr);
    t.join();
  });
}

}  // namespace
}  // namespace waitpoint
