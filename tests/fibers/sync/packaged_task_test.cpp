// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/packaged_task.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <stdexcept>

#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

TEST(PackagedTask, GivesWhatItsFunctionReturnsOrThrows) {
  in_every_order([] {
    packaged_task<int(int, std::unique_ptr<int>)> sums([](int a, std::unique_ptr<int> b) {
      if (a < 0) throw std::domain_error("negative");
      return a + *b;
    });
    future<int> sum = sums.get_future();
    thread runs(std::move(sums), 2, std::make_unique<int>(40));
    EXPECT_EQ(sum.get(), 42);
    runs.join();
    packaged_task<int(int)> fails([](int) -> int { throw std::domain_error("negative"); });
    sum = fails.get_future();
    fails(1);
    EXPECT_THROW(sum.get(), std::domain_error);
  });
}

TEST(PackagedTask, TakesFunctionsThatCanOnlyBeMoved) {
  in_order([] {
    packaged_task<int()> task([owned = std::make_unique<int>(7)] { return *owned; });
    future<int> seven = task.get_future();
    packaged_task<int()> moved = std::move(task);
    EXPECT_FALSE(task.valid());  // NOLINT: on purpose
    moved();
    EXPECT_EQ(seven.get(), 7);
    packaged_task<void()> drops([] { return 3; });
    drops();
    drops.get_future().get();
  });
}

TEST(PackagedTask, MisuseThrowsWhatTheStandardSays) {
  in_order([] {
    const auto expect = [](future_errc code, const std::function<void()>& call) {
      try {
        call();
        ADD_FAILURE() << "nothing was thrown";
      } catch (const future_error& error) {
        EXPECT_EQ(error.code(), code);
      }
    };
    packaged_task<void()> none;
    expect(future_errc::no_state, [&] { none(); });
    expect(future_errc::no_state, [&] { none.get_future(); });
    expect(future_errc::no_state, [&] { none.reset(); });
    int calls = 0;
    packaged_task<void()> task([&] { ++calls; });
    future<void> done = task.get_future();
    expect(future_errc::future_already_retrieved, [&] { task.get_future(); });
    task();
    expect(future_errc::promise_already_satisfied, [&] { task(); });
    EXPECT_EQ(calls, 1);
    task.reset();
    done = task.get_future();
    task = packaged_task<void()>();
    expect(future_errc::broken_promise, [&] { done.get(); });
  });
}

TEST(PackagedTask, CanBeReadyAtTheEndOfAThread) {
  in_every_order([] {
    packaged_task<int()> task([] { return 1; });
    future<int> result = task.get_future();
    thread runs([&] {
      task.make_ready_at_thread_exit();
      sleep_for(3ms);
    });
    EXPECT_EQ(result.get(), 1);
    EXPECT_EQ(now(), at(3ms));
    runs.join();
  });
}

TEST(Async, RunsAsAThreadOfItsOwn) {
  in_every_order([] {
    future<thread::id> other = async(
        launch::async,
        [](int ms) {
          sleep_for(std::chrono::milliseconds(ms));
          return this_thread::get_id();
        },
        5);
    future<int> second = async(
        [](std::unique_ptr<int> a) {
          sleep_for(5ms);
          return *a;
        },
        std::make_unique<int>(6));
    EXPECT_EQ(other.wait_for(1ms), future_status::timeout);
    EXPECT_NE(other.get(), this_thread::get_id());
    EXPECT_EQ(second.get(), 6);
    EXPECT_EQ(now(), at(5ms));
    EXPECT_THROW(async(launch::async, [] { throw std::runtime_error("no"); }).get(), std::runtime_error);
  });
}

TEST(Async, DestroyingTheLastFutureWaits) {
  in_every_order([] {
    (void)async(launch::async, [] { sleep_for(2ms); });
    EXPECT_EQ(now(), at(2ms));
    shared_future<void> shared = async(launch::async, [] { sleep_for(2ms); }).share();
    shared_future<void> copy = shared;
    shared = {};
    EXPECT_EQ(now(), at(2ms));
    copy = {};
    EXPECT_EQ(now(), at(4ms));
  });
}

TEST(Async, DeferredRunsWhereItIsFirstWaitedForWithoutATimeout) {
  in_every_order([] {
    int calls = 0;
    shared_future<thread::id> result = async(launch::deferred, [&] {
                                         ++calls;
                                         sleep_for(3ms);
                                         return this_thread::get_id();
                                       }).share();
    EXPECT_EQ(result.wait_for(1h), future_status::deferred);
    EXPECT_EQ(calls, 0);
    thread::id first;
    thread other([&] {
      sleep_for(1ms);
      first = result.get();
    });
    sleep_for(2ms);
    EXPECT_EQ(result.get(), other.get_id());
    EXPECT_EQ(now(), at(4ms));
    EXPECT_EQ(calls, 1);
    other.join();
    EXPECT_EQ(first, result.get());
    (void)async(launch::deferred, [&] { ++calls; });
    EXPECT_EQ(calls, 1);
  });
}

TEST(Async, CallsThatWaitForEachOtherAreADeadlock) {
  const Report report = simulate([] {
    std::optional<shared_future<void>> a, b;
    a = async(launch::async, [&] {
          sleep_for(1ms);
          b->wait();
        }).share();
    b = async(launch::async, [&] {
          sleep_for(1ms);
          a->wait();
        }).share();
    sleep_for(1h);
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_EQ(report.end_time, at(1ms));
  EXPECT_NE(report.text.find("2 tasks wait for each other"), std::string::npos) << report;
}

TEST(Async, ARunThatEndsBeforeLeavesNothingBehind) {
  const Report report = simulate([] {
    thread({.name = "service", .service = true}, [] {
      const future<void> waits = async(launch::async, [] {
        thread({.name = "blocked", .service = true}, [] { sleep_for(1h); }).detach();
        throw std::runtime_error("dropped");
      });
      sleep_for(1h);
    }).detach();
    sleep_for(1ms);
  });
  EXPECT_TRUE(report.passed && report.abandoned.empty()) << report;
  const Report broken = simulate([] {
    const auto sleeps = async(launch::async, [] { sleep_for(1h); });
    throw std::runtime_error("breaks off");
  });
  EXPECT_EQ(broken.end_time, at(1h));  // the future's destructor waits, as in the standard
  EXPECT_TRUE(broken.abandoned.empty()) << broken;
}

}  // namespace
}  // namespace waitpoint
