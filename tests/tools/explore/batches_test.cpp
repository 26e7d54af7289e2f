// SPDX-License-Identifier: BSD-3-Clause
#include "tools/explore/search/batches.hpp"

#include <gtest/gtest.h>

namespace waitpoint::tools {
namespace {

constexpr std::uint64_t any_place = ~std::uint64_t{0};

/// Batches of at most 16 after some whose schedules took 0.1 ms each.
Batches of_short_schedules() {
  Batches batches(16);
  for (int i = 0; i < 10; ++i) {
    const std::uint32_t count = batches.size();
    batches.start({0, 0, count}, 0);
    batches.end(0, count, count * 0.0001);
  }
  return batches;
}

TEST(Batches, GrowToTheLimitForShortSchedules) {
  EXPECT_EQ(Batches(16).size(), 1u);
  EXPECT_EQ(of_short_schedules().size(), 16u);
}

TEST(Batches, ShrinkToOneAfterASlowSchedule) {
  Batches batches = of_short_schedules();
  batches.start({0, 0, 16}, 0);
  batches.end(0, 1, 0.1);
  EXPECT_EQ(batches.size(), 1u);
}

TEST(Batches, LeaveWhatFollowsASchedulesFailure) {
  Batches batches = of_short_schedules();
  batches.start({20, 120, 16}, 0);
  batches.start({36, 136, 16}, 0);
  batches.end(36, 16, 0.002);
  batches.end(20, 5, 0.001);
  EXPECT_FALSE(batches.take_left(25));
  const auto left = batches.take_left(any_place);
  ASSERT_TRUE(left);
  EXPECT_EQ(left->place, 25u);
  EXPECT_EQ(left->number, 125u);
  EXPECT_EQ(left->count, 11u);
  EXPECT_FALSE(batches.take_left(any_place));
}

TEST(Batches, RepeatOneByOneAfterALostProcess) {
  Batches batches = of_short_schedules();
  batches.start({20, 120, 3}, 0);
  EXPECT_TRUE(batches.divide(20));
  for (std::uint64_t place = 20; place < 23; ++place) {
    const auto left = batches.take_left(any_place);
    ASSERT_TRUE(left);
    EXPECT_EQ(left->place, place);
    EXPECT_EQ(left->count, 1u);
    batches.start(*left, 0);
  }
  EXPECT_FALSE(batches.take_left(any_place));
  EXPECT_FALSE(batches.divide(21));
}

}  // namespace
}  // namespace waitpoint::tools
