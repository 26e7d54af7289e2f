// SPDX-License-Identifier: BSD-3-Clause
// Strategies: each finds the bugs that it is made for, and none hangs on spinning tasks.
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "fibers/explore/explore.hpp"
#include "fibers/explore/strategies/strategy.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint {
namespace {

const std::vector<std::string> all = {"portfolio", "fifo", "random", "pct:2",     "pct:3",     "pos", "urw",
                                      "surw",      "dfs",  "dpor",   "bounded:1", "bounded:2", "rff", "goexplore"};

// Two tasks append a letter each, `each` times: all possible words.
std::set<std::string> words(const std::string& strategy, int each, bool& complete, std::uint64_t& schedules) {
  std::set<std::string> found;
  const ExploreReport report = explore(
      [&] {
        atomic<int> page{0};
        std::string word;
        const auto write = [&](char letter) {
          for (int i = 0; i < each; ++i) {
            page.fetch_add(1);
            word += letter;
          }
        };
        thread a([&] { write('a'); });
        thread b([&] { write('b'); });
        a.join();
        b.join();
        found.insert(word);
      },
      {.strategy = strategy, .iterations = 2'000'000});
  EXPECT_TRUE(report.passed) << report;
  complete = report.complete;
  schedules = report.schedules;
  return found;
}

TEST(Strategies, ExhaustiveOnesFindAllOrdersAndSaySo) {
  bool complete = false;
  std::uint64_t by_dfs = 0, by_dpor = 0;
  EXPECT_EQ(words("dfs", 2, complete, by_dfs).size(), 6U);
  EXPECT_TRUE(complete);
  EXPECT_EQ(words("dpor", 2, complete, by_dpor).size(), 6U);
  EXPECT_TRUE(complete);
  EXPECT_LT(by_dpor * 10, by_dfs);
  EXPECT_EQ(words("dpor", 4, complete, by_dpor).size(), 70U);
  EXPECT_TRUE(complete);
}

TEST(Strategies, ABoundOnPreemptionsLeavesOutWhatNeedsMore) {
  bool complete = false;
  std::uint64_t schedules = 0;
  const std::set<std::string> one = words("bounded:1", 2, complete, schedules);
  EXPECT_FALSE(complete);
  EXPECT_TRUE(one.contains("abba"));
  EXPECT_FALSE(one.contains("abab"));
  EXPECT_TRUE(words("bounded:2", 2, complete, schedules).contains("abab"));
}

TEST(Strategies, LoopsThatWaitForOthersEndUnderEachOfThem) {
  for (const std::string& strategy : all) {
    const ExploreReport report = explore(
        [] {
          atomic<bool> go{false};
          atomic<int> gone{0};
          thread on_a_flag([&] {
            while (!go.load()) {
            }
            gone.fetch_add(1);
          });
          thread with_yield([&] {
            while (!go.load()) this_thread::yield();
            gone.fetch_add(1);
          });
          thread by_the_clock([&] {
            while (!go.load() && now() == Time()) {
            }
            gone.fetch_add(1);
          });
          go.store(true);
          on_a_flag.join();
          with_yield.join();
          by_the_clock.join();
          check(gone.load() == 3);
        },
        {.strategy = strategy, .iterations = 300});
    EXPECT_TRUE(report.passed) << strategy << ": " << report;
  }
}

TEST(Strategies, OneSeedIsOneCampaign) {
  for (const std::string& strategy : all) {
    std::uint64_t failed_at[3];
    std::string token[3];
    for (int i = 0; i < 3; ++i) {
      const ExploreReport report = explore(
          [] {
            atomic<int> count{0};
            std::vector<thread> threads;
            threads.reserve(4);
            for (int t = 0; t < 4; ++t)
              threads.emplace_back([&] {
                const int seen = count.load();
                count.store(seen + 1);
              });
            for (thread& t : threads) t.join();
            check(count.load() > 1);
          },
          {.strategy = strategy, .seed = i == 2 ? 8U : 7U, .minimize = false});
      failed_at[i] = report.failed_at;
      token[i] = report.replay.size() > 6 ? report.replay.substr(6) : "";  // without the number of the call
    }
    EXPECT_EQ(failed_at[0], failed_at[1]) << strategy;
    EXPECT_EQ(token[0], token[1]) << strategy;
    if (strategy == "random" || strategy == "pos") {
      EXPECT_NE(token[0], token[2]);
    }
  }
}

}  // namespace
}  // namespace waitpoint
