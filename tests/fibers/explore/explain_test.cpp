// SPDX-License-Identifier: BSD-3-Clause
// The explanation of a failure by explore(): the two events whose order matters, with the call stacks of both.
#include <gtest/gtest.h>

#include <string>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint {
namespace {

using namespace std::chrono_literals;

// The line that begins with `label` and the lines indented more than it.
std::string told_under(const std::string& text, const std::string& label) {
  const std::size_t begin = text.find("\n  " + label);
  if (begin == std::string::npos) return "";
  std::size_t end = begin + 1;
  do end = text.find('\n', end + 1);
  while (text.compare(end, 5, "\n    ") == 0);
  return text.substr(begin + 1, end - begin - 1);
}

// A third task is unrelated to the failure, and first in the default order.
ExploreReport explore_reader_and_writer(const char* strategy) {
  return explore(
      [] {
        atomic<int> x{0};
        thread other({.name = "other"}, [] {});
        thread writer({.name = "writer"}, [&] { x.store(1); });
        thread reader({.name = "reader"}, [&] { check(x.load() == 1, "read too early"); });
        for (thread* each : {&other, &writer, &reader}) each->join();
      },
      {.strategy = strategy});
}

TEST(Explain, NamesTheTwoEventsAtOneObjectWhoseOrderMatters) {
  for (const char* strategy : {"portfolio", "random", "dfs"}) {
    const ExploreReport report = explore_reader_and_writer(strategy);
    ASSERT_FALSE(report.passed);
    const std::string here = told_under(report.text, "first in the failing run:");
    const std::string there = told_under(report.text, "first in a passing run:");
    EXPECT_TRUE(contains(here, " s: reader#3, about to load atomic #")) << report;
    EXPECT_TRUE(contains(there, " s: writer#2, about to store atomic #")) << report;
    // Both have a call stack, since both were running when they reached the object.
    EXPECT_TRUE(contains(here, "\n      at ")) << report;
    EXPECT_TRUE(contains(there, "\n      at ")) << report;
    EXPECT_FALSE(contains(here + there, "other")) << report;
  }
}

// The other task must not lock between the first task's two critical sections: the lock matters, not the unlock in
// between.
TEST(Explain, NamesTheNextHolderOfALock) {
  const ExploreReport report = explore([] {
    mutex account;
    int balance = 0;
    const auto add = [&] {
      int seen = 0;
      {
        const std::lock_guard guard(account);
        seen = balance;
      }
      const std::lock_guard guard(account);
      balance = seen + 1;
    };
    thread a(add), b(add);
    a.join();
    b.join();
    check(balance == 2, "an update was lost");
  });
  ASSERT_FALSE(report.passed);
  EXPECT_TRUE(contains(told_under(report.text, "first in the failing run:"), "about to lock mutex")) << report;
  EXPECT_TRUE(contains(told_under(report.text, "first in a passing run:"), "about to lock mutex")) << report;
}

TEST(Explain, SaysWhereItIsNoOrderOfTwoEvents) {
  const ExploreReport report = explore([] {
    compute(1ms, 3ms);
    check(now() >= Time() + 2ms, "too early");
  });
  ASSERT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, "no two events at one object are reordered in the passing run")) << report;
  EXPECT_EQ(told_under(report.text, "first in the failing run:"), "") << report;
}

}  // namespace
}  // namespace waitpoint
