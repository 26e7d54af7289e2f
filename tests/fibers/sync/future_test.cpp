// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/future.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "fibers/sync/fiber_local.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

/// The code of the future_error that `call` throws.
template <class Call>
std::error_code error_of(const Call& call) {
  try {
    call();
  } catch (const future_error& error) {
    return error.code();
  }
  return {};
}

TEST(Future, GetWaitsForWhatThePromiseIsGiven) {
  in_every_order([] {
    promise<std::string> gives;
    future<std::string> takes = gives.get_future();
    thread other([&] {
      sleep_for(2ms);
      compute(1ms);
      gives.set_value("here");
    });
    EXPECT_EQ(takes.get(), "here");
    EXPECT_EQ(now(), at(3ms));
    EXPECT_FALSE(takes.valid());
    other.join();
  });
}

TEST(Future, ReadyValueIsTakenAtOnce) {
  in_every_order([] {
    promise<int> gives;
    gives.set_value(3);
    future<int> takes = gives.get_future();
    EXPECT_EQ(takes.wait_for(0s), future_status::ready);
    takes.wait();
    EXPECT_EQ(takes.get(), 3);
    EXPECT_EQ(now(), Time());
  });
}

TEST(Future, TakesReferencesNothingAndWhatCanOnlyBeMoved) {
  in_order([] {
    int number = 1;
    promise<int&> reference;
    reference.set_value(number);
    reference.get_future().get() = 2;
    EXPECT_EQ(number, 2);
    promise<void> nothing;
    nothing.set_value();
    nothing.get_future().get();
    promise<std::unique_ptr<int>> owned;
    owned.set_value(std::make_unique<int>(5));
    EXPECT_EQ(*owned.get_future().get(), 5);
  });
}

TEST(Future, TimedWaitsEndAtTheDeadlineOrWithTheValue) {
  in_every_order([] {
    promise<int> gives;
    future<int> takes = gives.get_future();
    EXPECT_EQ(takes.wait_for(0s), future_status::timeout);
    EXPECT_EQ(takes.wait_for(-1s), future_status::timeout);
    EXPECT_EQ(now(), Time());
    EXPECT_EQ(takes.wait_for(2ms), future_status::timeout);
    EXPECT_EQ(now(), at(2ms));
    EXPECT_EQ(takes.wait_until(steady_clock::time_point(3ms)), future_status::timeout);
    EXPECT_EQ(takes.wait_until(system_clock::now() + 1ms), future_status::timeout);
    EXPECT_EQ(now(), at(4ms));
    thread other([&] {
      sleep_for(1ms);
      gives.set_value(1);
    });
    EXPECT_EQ(takes.wait_for(std::chrono::hours::max()), future_status::ready);
    EXPECT_EQ(now(), at(5ms));
    other.join();
  });
}

TEST(Future, GivenAtTheInstantOfTheDeadlineTheValueIsNeverLost) {
  expect_both([] {
    promise<int> gives;
    future<int> takes = gives.get_future();
    bool ready = false;
    thread waits([&] {
      ready = takes.wait_for(5ms) == future_status::ready;
      EXPECT_EQ(takes.get(), 4);
      EXPECT_EQ(now(), at(5ms));
    });
    sleep_for(5ms);
    gives.set_value(4);
    waits.join();
    return ready;
  });
}

TEST(Future, AnExceptionIsThrownWhereTheResultIsWanted) {
  in_every_order([] {
    promise<int> gives;
    future<int> takes = gives.get_future();
    gives.set_exception(std::make_exception_ptr(std::out_of_range("far")));
    EXPECT_EQ(takes.wait_for(0s), future_status::ready);
    EXPECT_THROW(takes.get(), std::out_of_range);
    EXPECT_FALSE(takes.valid());
  });
}

TEST(Future, MisuseThrowsWhatTheStandardSays) {
  in_order([] {
    EXPECT_EQ(error_of([] { future<int>().get(); }), future_errc::no_state);
    EXPECT_EQ(error_of([] { future<int>().wait(); }), future_errc::no_state);
    EXPECT_EQ(error_of([] { (void)shared_future<int>().wait_for(1s); }), future_errc::no_state);
    promise<int> gives;
    future<int> takes = gives.get_future();
    EXPECT_EQ(error_of([&] { gives.get_future(); }), future_errc::future_already_retrieved);
    gives.set_value(1);
    EXPECT_EQ(error_of([&] { gives.set_value(2); }), future_errc::promise_already_satisfied);
    EXPECT_EQ(error_of([&] { gives.set_exception(nullptr); }), future_errc::promise_already_satisfied);
    EXPECT_EQ(takes.get(), 1);
    const promise<int> moved = std::move(gives);
    EXPECT_EQ(error_of([&] { gives.set_value(2); }), future_errc::no_state);  // NOLINT: on purpose
    EXPECT_EQ(error_of([&] { gives.get_future(); }), future_errc::no_state);
  });
}

TEST(Future, APromiseThatGoesWithoutAValueIsBroken) {
  in_every_order([] {
    future<int> takes;
    thread other([&] {
      promise<int> gives;
      takes = gives.get_future();
      sleep_for(2ms);
    });
    sleep_for(1ms);
    EXPECT_EQ(error_of([&] { takes.get(); }), future_errc::broken_promise);
    EXPECT_EQ(now(), at(2ms));
    other.join();
    promise<int> replaced;
    takes = replaced.get_future();
    replaced = promise<int>();
    EXPECT_EQ(error_of([&] { takes.get(); }), future_errc::broken_promise);
  });
}

TEST(Future, SharedOnesAllGetIt) {
  in_every_order([] {
    promise<std::string> gives;
    const shared_future<std::string> shared = gives.get_future().share();
    int got = 0;
    std::vector<thread> all;
    for (int i = 0; i < 3; ++i)
      all.emplace_back([&, mine = shared] {
        EXPECT_EQ(mine.get(), "for all");
        EXPECT_EQ(&mine.get(), &shared.get());
        EXPECT_EQ(now(), at(1ms));
        ++got;
      });
    sleep_for(1ms);
    gives.set_value("for all");
    for (thread& t : all) t.join();
    EXPECT_EQ(got, 3);
    promise<void> fails;
    const shared_future<void> failed = fails.get_future();
    fails.set_exception(std::make_exception_ptr(std::runtime_error("no")));
    EXPECT_THROW(failed.get(), std::runtime_error);
    EXPECT_THROW(failed.get(), std::runtime_error);
  });
}

TEST(Future, CanBeReadyAtTheEndOfAThread) {
  in_every_order([] {
    static bool local_gone;
    local_gone = false;
    struct Local {
      ~Local() { local_gone = true; }
    };
    fiber_local<Local> local;
    promise<int> gives, fails;
    future<int> takes = gives.get_future(), takes_failure = fails.get_future();
    thread other([&] {
      (void)*local;
      gives.set_value_at_thread_exit(3);
      fails.set_exception_at_thread_exit(std::make_exception_ptr(std::runtime_error("no")));
      EXPECT_EQ(error_of([&] { gives.set_value(4); }), future_errc::promise_already_satisfied);
      sleep_for(2ms);
    });
    EXPECT_EQ(takes.wait_for(1ms), future_status::timeout);
    EXPECT_EQ(takes.get(), 3);
    EXPECT_TRUE(local_gone);
    EXPECT_EQ(now(), at(2ms));
    EXPECT_THROW(takes_failure.get(), std::runtime_error);
    other.join();
  });
}

TEST(Future, WaitingForAnUnkeptPromiseIsReported) {
  const Report report = simulate([] {
    promise<int> gives;
    gives.get_future().get();
  });
  EXPECT_EQ(report.end, RunEnd::deadlock);
  EXPECT_NE(report.text.find("waits (wait) for future #1"), std::string::npos) << report;
}

TEST(Future, ARunThatEndsBeforeLeavesNothingBehind) {
  const Report report = simulate([] {
    auto gives = std::make_shared<promise<int>>();
    auto takes = std::make_shared<future<int>>(gives->get_future());
    thread({.name = "waits", .service = true}, [takes] { takes->get(); }).detach();
    thread({.name = "keeps", .service = true}, [gives] { sleep_for(1h); }).detach();
    sleep_for(1ms);
  });
  EXPECT_TRUE(report.passed && report.abandoned.empty()) << report;
}

}  // namespace
}  // namespace waitpoint
