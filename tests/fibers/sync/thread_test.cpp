// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/thread.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

#include "fibers/sync/mutex.hpp"
#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;
using this_thread::sleep_until;

TEST(Thread, JoinWaitsForTheEndAndTakesItsTime) {
  in_every_order([] {
    bool done = false;
    thread t([&] {
      sleep_for(5ms);
      done = true;
    });
    EXPECT_TRUE(t.joinable());
    EXPECT_NE(t.get_id(), thread::id());
    t.join();
    EXPECT_TRUE(done);
    EXPECT_EQ(now(), at(5ms));
    EXPECT_FALSE(t.joinable());
    EXPECT_EQ(t.get_id(), thread::id());
  });
}

TEST(Thread, JoinAfterTheEndReturnsAtOnce) {
  in_every_order([] {
    thread t([] { sleep_for(5ms); });
    sleep_for(8ms);
    t.join();
    EXPECT_EQ(now(), at(8ms));
  });
}

TEST(Thread, ARunLastsAsLongAsItsDetachedThreads) {
  const Report report = in_order([] { thread([] { sleep_for(50ms); }).detach(); });
  EXPECT_EQ(report.end_time, at(50ms));
}

TEST(Thread, AServiceDoesNotKeepTheRunAlive) {
  const Report report = in_order([] {
    thread({.name = "service", .service = true}, [] {
      for (;;) sleep_for(7ms);
    }).detach();
    sleep_for(20ms);
  });
  EXPECT_EQ(report.end_time, at(20ms));
}

TEST(Thread, TakesArgumentsAndMoveOnlyOnes) {
  in_order([] {
    int sum = 0;
    auto owned = std::make_unique<int>(40);
    thread t([](int a, std::unique_ptr<int> b, int& out) { out = a + *b; }, 2, std::move(owned), std::ref(sum));
    t.join();
    EXPECT_EQ(sum, 42);
    struct Counter {
      int calls = 0;
      void call(int n) { calls += n; }
    } counter;
    thread member(&Counter::call, &counter, 3);
    member.join();
    EXPECT_EQ(counter.calls, 3);
  });
}

TEST(Thread, CanBeMovedAndSwapped) {
  in_order([] {
    thread a([] { sleep_for(1ms); }), b;
    const thread::id id = a.get_id();
    b = std::move(a);
    EXPECT_FALSE(a.joinable());
    EXPECT_EQ(b.get_id(), id);
    a.swap(b);
    EXPECT_EQ(a.get_id(), id);
    thread c(std::move(a));
    c.join();
    EXPECT_EQ(now(), at(1ms));
  });
}

TEST(Thread, EachHasItsOwnIdInsideAndOutside) {
  in_order([] {
    std::set<thread::id> ids = {this_thread::get_id()};
    std::vector<thread> threads;
    for (int i = 0; i < 20; ++i)
      threads.emplace_back([&] {
        EXPECT_TRUE(ids.insert(this_thread::get_id()).second);
        thread child([] {});
        EXPECT_TRUE(ids.insert(child.get_id()).second);
        child.join();
      });
    for (thread& t : threads) EXPECT_TRUE(t.joinable());
    for (thread& t : threads) t.join();
    EXPECT_EQ(ids.size(), 41u);
  });
}

TEST(Thread, LetsGoOfItsFunctionWhenItEnds) {
  in_order([] {
    auto shared = std::make_shared<int>(1);
    thread t([shared] { EXPECT_EQ(shared.use_count(), 2); });
    t.join();
    EXPECT_EQ(shared.use_count(), 1);
  });
}

TEST(Thread, AnExceptionThatEscapesEndsTheRunAndIsReported) {
  bool went_on = false;
  const Report report = simulate([&] {
    thread t([] {
      sleep_for(3ms);
      throw std::runtime_error("the wheel fell off");
    });
    sleep_for(5ms);
    went_on = true;
    t.join();
  });
  EXPECT_FALSE(report.passed);
  EXPECT_FALSE(went_on);
  EXPECT_NE(report.text.find("escaped from task thread of environment at 0.003000000 s: the wheel fell off"),
            std::string::npos)
      << report;
  EXPECT_EQ(report.end_time, at(3ms));
  const Report of_main = simulate([] { throw 7; });
  EXPECT_NE(of_main.text.find("unknown type"), std::string::npos) << of_main;
}

TEST(Thread, EscapedExceptionIsRethrownToTheCallerOfRun) {
  Simulation simulation;
  simulation.spawn(simulation.environment(), {}, [] {
    sleep_for(3ms);
    throw std::out_of_range("there");
  });
  EXPECT_EQ(simulation.run_before(at(3ms)), RunEnd::time_reached);
  EXPECT_THROW(simulation.run_before(), std::out_of_range);
  EXPECT_THROW(simulation.run_before(), std::out_of_range);
}

TEST(Simulation, WithoutTasksOrWithIdleServicesAloneHasEnded) {
  Simulation empty;
  EXPECT_EQ(empty.run_before(), RunEnd::ended);
  EXPECT_EQ(empty.trouble(), "");
  Simulation services;
  mutex m;
  for (int i = 0; i < 2; ++i)
    services.spawn(services.environment(), {.service = true}, [&] {
      m.lock();
      sleep_for(1ms);
      sync::block(*std::make_unique<kernel::Object>("object"));
    });
  EXPECT_EQ(services.run_before(), RunEnd::ended);
  EXPECT_EQ(services.trouble(), "");
}

TEST(Simulation, ARunThatSleepsForEverIsNoSilentFailure) {
  const Report report = simulate([] { sleep_until(Time::max()); });
  EXPECT_FALSE(report.passed);
  EXPECT_NE(report.text, "");
}

TEST(Sleep, EndsAtTheTimeAskedForAndNeverGoesBack) {
  in_every_order([] {
    sleep_for(2ms);
    EXPECT_EQ(now(), at(2ms));
    sleep_for(Duration(1ms));
    EXPECT_EQ(now(), at(3ms));
    sleep_until(at(10ms));
    EXPECT_EQ(steady_clock::now().time_since_epoch(), 10ms);
    sleep_until(steady_clock::time_point(4ms));
    sleep_for(-5ms);
    sleep_for(0ms);
    EXPECT_EQ(now(), at(10ms));
    sleep_for(std::chrono::duration<double>(0.5e-9));  // never shorter than requested
    EXPECT_EQ(now(), at(10ms + 1ns));
  });
}

// Computing delays the visible effects that follow it, whatever the order of execution.
TEST(Compute, MovesTheLocalTimeAndOrdersWhatFollows) {
  in_every_order([] {
    mutex m;
    std::vector<int> order;
    std::vector<thread> threads;
    for (const int cost : {5, 3, 4})
      threads.emplace_back([&, cost] {
        compute(Duration(cost * 1ms));
        EXPECT_EQ(now(), at(cost * 1ms));
        const std::lock_guard guard(m);
        order.push_back(cost);
        EXPECT_EQ(now(), at(cost * 1ms));
      });
    for (thread& t : threads) t.join();
    EXPECT_EQ(order, (std::vector{3, 4, 5}));
  });
}

TEST(Compute, IsNoWaitpoint) {
  in_every_order([] {
    int value = 0;
    thread t([&] { value = 1; });
    for (int i = 0; i < 100; ++i) compute(1ms);
    EXPECT_EQ(value, 0);
    this_thread::yield();
    EXPECT_EQ(value, 1);
    t.join();
  });
}

TEST(Yield, LetsAllTiesRunInTheDefaultOrder) {
  in_order([] {
    int ran = 0;
    std::vector<thread> threads;
    for (int i = 0; i < 10; ++i) threads.emplace_back([&] { ++ran; });
    this_thread::yield();
    EXPECT_EQ(ran, 10);
    for (thread& t : threads) t.join();
  });
}

TEST(Yield, APollingLoopEndsInEveryOrder) {
  in_every_order([] {
    bool flag = false;
    thread setter([&] { flag = true; });
    while (!flag) this_thread::yield();
    setter.join();
    mutex held;
    held.lock();
    thread holder([&] {
      while (!held.try_lock()) {  // spins without a yield: its ties get their turn nevertheless
      }
      held.unlock();
    });
    this_thread::yield();
    held.unlock();
    holder.join();
  });
}

}  // namespace
}  // namespace waitpoint
