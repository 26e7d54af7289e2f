// SPDX-License-Identifier: BSD-3-Clause
// The option for weak memory, its tokens and its reports. This file is not instrumented.
#include <gtest/gtest.h>

#include <cstdlib>

#include "fibers/explore/explore.hpp"
#include "fibers/explore/schedules/token.hpp"
#include "tests/fibers/explore/weak_memory/memory_uses.hpp"
#include "tests/fibers/text/contains.hpp"

namespace waitpoint::weak_memory {
namespace {

TEST(MemoryOption, IsOffByDefault) { EXPECT_TRUE(explore(buffer_stores, {.iterations = 200}).passed); }

TEST(MemoryOption, ExplainsTheOlderValues) {
  const ExploreReport report = explore(buffer_stores, {.memory = Memory::weak});
  EXPECT_FALSE(report.passed);
  EXPECT_TRUE(contains(report.text, "both stores are missed")) << report;
  EXPECT_TRUE(contains(report.text, "1 switch away from the default order fails")) << report;
  EXPECT_TRUE(contains(report.text, " (load memory #")) << report;
  EXPECT_TRUE(contains(report.text,
                       "reads an older value, as C++ allows for relaxed: 0, the one before the first atomic store"))
      << report;
  EXPECT_TRUE(contains(report.text, "; it passes if it reads the newest value: 1, stored by thread#1 at ")) << report;
  EXPECT_TRUE(contains(report.text, "memory_uses.cpp:")) << report;
}

TEST(MemoryOption, IsInTheToken) {
  const ExploreReport found = explore(buffer_stores, {.memory = Memory::weak});
  std::string token = found.replay;
  ASSERT_TRUE(token.starts_with("wx1.1w.")) << token;
  EXPECT_EQ(exploration::read_token(token).memory, Memory::weak);
  EXPECT_EQ(exploration::to_text(exploration::read_token(token)), token);
  token.replace(0, 6, "wx1.2w");  // the next call of this test
  const ExploreReport again = explore(buffer_stores, {.replay = token});
  EXPECT_TRUE(contains(again.text, "the replayed schedule failed: ")) << again;
  EXPECT_TRUE(contains(again.text, "both stores are missed")) << again;
}

TEST(MemoryOption, IsGivenByTheEnvironmentToo) {
  setenv("WAITPOINT_MEMORY", "weak", 1);
  EXPECT_FALSE(explore(buffer_stores).passed);
  setenv("WAITPOINT_MEMORY", "strong", 1);
  EXPECT_EXIT((void)explore(buffer_stores), testing::ExitedWithCode(2),
              "waitpoint: WAITPOINT_MEMORY: expected sc or weak, found 'strong'");
  unsetenv("WAITPOINT_MEMORY");
}

}  // namespace
}  // namespace waitpoint::weak_memory
