// SPDX-License-Identifier: BSD-3-Clause
// Schedules are counted up to the order of independent events.
#include <gtest/gtest.h>

#include "fibers/explore/explore.hpp"
#include "fibers/io/pipe.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/condition_variable.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

// All schedules of two tasks, or many.
ExploreReport all_of(const std::function<void()>& one, const std::function<void()>& other,
                     const ExploreOptions& options = {.strategy = "dfs", .iterations = 1'000'000}) {
  return explore(
      [&] {
        thread first(one), second(other);
        first.join();
        second.join();
      },
      options);
}

TEST(TraceHash, TasksThatShareNothingHaveOneTrace) {
  atomic<int> mine(0), yours(0);
  const ExploreReport report = all_of([&] { mine.store(1); }, [&] { yours.store(1); });
  EXPECT_TRUE(report.complete);
  EXPECT_GT(report.schedules, 10U);
  EXPECT_EQ(report.distinct, 1U);
}

TEST(TraceHash, ReadsCommuteAndWritesDoNot) {
  atomic<int> number(0);
  const auto read = [&] { (void)number.load(); };
  const auto add = [&] { number.fetch_add(1); };
  EXPECT_EQ(all_of(add, add).distinct, 2U);
  EXPECT_EQ(all_of(add, read).distinct, 2U);
  atomic<int> known(0);
  const auto know = [&] {
    known.store(1);
    (void)known.load();
  };
  EXPECT_EQ(all_of(know, [&] { (void)known.load(); }).distinct, 2U);
}

TEST(TraceHash, CountsTheOrdersOfCriticalSectionsWhateverIsAroundThem) {
  mutex lock;
  atomic<int> mine(0), yours(0);
  const auto work = [&](atomic<int>& own) {
    own.fetch_add(1);
    const std::lock_guard guard(lock);
    own.fetch_add(1);
  };
  const ExploreReport report =
      all_of([&] { work(mine); }, [&] { work(yours); }, {.strategy = "random", .iterations = 2'000});
  EXPECT_EQ(report.distinct, 4U);  // who locks first, and whether the other comes before it has unlocked
}

TEST(TraceHash, KnowsWhatWaitsAndChannelsDependOn) {
  atomic<int> number(0);
  mutex lock, other;
  condition_variable condition;
  const auto notify = [&] { condition.notify_one(); };
  const auto wait = [&] {
    std::unique_lock<mutex> held(lock);
    condition.wait_for(held, std::chrono::seconds(1));
  };
  // A wait releases a lock: it is ordered with each use of one, but with nothing else.
  const auto lock_other = [&] { const std::lock_guard guard(other); };
  EXPECT_EQ(all_of(wait, [&] { number.store(1); }).distinct, 1U);
  EXPECT_GT(all_of(wait, lock_other).distinct, 1U);
  EXPECT_GT(all_of(wait, notify).distinct, 1U);
  const ExploreReport pipes = explore(
      [] {
        auto first = io::make_pipe(), second = io::make_pipe();
        const auto write = [](auto& ends) {
          const std::byte letter{1};
          (void)ends.writer.write({&letter, 1});
        };
        thread one([&] { write(first); }), two([&] { write(second); });
        one.join();
        two.join();
      },
      {.strategy = "dfs", .iterations = 1'000'000});
  EXPECT_GT(pipes.distinct, 1U);
}

}  // namespace
}  // namespace waitpoint
