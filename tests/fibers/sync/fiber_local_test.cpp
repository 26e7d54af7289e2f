// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/fiber_local.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/fibers/sync/orders.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;
using this_thread::sleep_for;

fiber_local<int> counter;

TEST(FiberLocal, EachTaskHasItsOwn) {
  in_every_order([] {
    EXPECT_EQ(*counter, 0);
    *counter = 7;
    std::vector<thread> all;
    for (int i = 1; i <= 4; ++i)
      all.emplace_back([i] {
        for (int k = 0; k < 10; ++k) {
          EXPECT_EQ(*counter, k * i);
          *counter += i;
          this_thread::yield();
        }
      });
    for (thread& t : all) t.join();
    EXPECT_EQ(*counter, 7);
  });
}

struct Noted {
  explicit Noted(std::string name_of, std::string& log_of) : name(std::move(name_of)), log(log_of) {
    log += "+" + name;
  }
  ~Noted() { log += "-" + name; }
  std::string name;
  std::string& log;
};

TEST(FiberLocal, IsMadeAtTheFirstUseAndGoesAtTheTasksEndTheLatestFirst) {
  in_every_order([] {
    std::string log;
    fiber_local<Noted> a([&] { return Noted("a", log); }), b([&] { return Noted("b", log); });
    thread t([&] {
      const Noted own("own", log);
      EXPECT_EQ(b->name, "b");
      EXPECT_EQ(a->name, "a");
      EXPECT_EQ(&b.get(), &b.get());
      sleep_for(1ms);
    });
    EXPECT_EQ(log, "");
    t.join();
    EXPECT_EQ(log, "+own+b+a-own-a-b");
  });
}

TEST(FiberLocal, AlsoGoesWhenAnExceptionLeavesTheTaskOrTheRunIsOver) {
  std::string log;
  fiber_local<Noted> left([&] { return Noted("left", log); });
  const Report failed = simulate([&] {
    (void)*left;
    throw std::runtime_error("enough");
  });
  EXPECT_NE(failed.text.find("enough"), std::string::npos);
  EXPECT_EQ(log, "+left-left");
  log.clear();
  const Report report = simulate([&] {
    thread({.name = "service", .service = true}, [&] {
      (void)*left;
      sleep_for(1h);
    }).detach();
    sleep_for(1ms);
  });
  EXPECT_TRUE(report.passed && report.abandoned.empty()) << report;
  EXPECT_EQ(log, "+left-left");
}

TEST(FiberLocal, AJoinedThreadHasLetGoOfItsOwn) {
  in_every_order([] {
    struct Slow {
      ~Slow() { sleep_for(2ms); }
    };
    fiber_local<Slow> slow;
    thread t([&] { (void)*slow; });
    t.join();
    EXPECT_EQ(now(), Time() + 2ms);
  });
}

TEST(FiberLocal, ValuesFirstUsedByADestructorAreDestroyed) {
  in_order([] {
    static std::string log;
    log.clear();
    static fiber_local<Noted> late([] { return Noted("late", log); });
    struct UsesLate {
      ~UsesLate() { (void)*late; }
    };
    fiber_local<UsesLate> uses;
    thread([&] { (void)*uses; }).join();
    EXPECT_EQ(log, "+late-late");
  });
}

TEST(FiberLocal, ANewVariableDoesNotFindTheValuesOfOneThatWasThereBefore) {
  in_order([] {
    for (int i = 0; i < 3; ++i) {
      fiber_local<int> fresh([i] { return 10 * i; });
      EXPECT_EQ(*fresh, 10 * i);
      *fresh = -1;
    }
  });
}

TEST(FiberLocalDeathTest, UseOutsideAnyTask) {
  EXPECT_DEATH(*counter = 1, "a simulated primitive is used outside a simulated task");
}

}  // namespace
}  // namespace waitpoint
