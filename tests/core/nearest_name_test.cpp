// SPDX-License-Identifier: BSD-3-Clause
#include "core/nearest_name.hpp"

#include <gtest/gtest.h>

#include <array>

namespace waitpoint {
namespace {

constexpr std::array<std::string_view, 4> known = {"step_ms", "shapes", "map", "include"};

TEST(NearestName, CountsEdits) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("map", ""), 3u);
  EXPECT_EQ(edit_distance("map", "map"), 0u);
  EXPECT_EQ(edit_distance("mapp", "map"), 1u);
  EXPECT_EQ(edit_distance("mop", "map"), 1u);
  EXPECT_EQ(edit_distance("amp", "map"), 1u) << "swapped neighbours are one edit";
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("ca", "abc"), 3u) << "a swapped pair is not edited again";
}

TEST(NearestName, FindsTheMisspeltName) {
  EXPECT_EQ(nearest_name("steps_ms", known), "step_ms");
  EXPECT_EQ(nearest_name("shaeps", known), "shapes");
  EXPECT_EQ(nearest_name("map", known), "map");
}

TEST(NearestName, SuggestsNothingForAnUnrelatedWord) {
  EXPECT_EQ(nearest_name("colour", known), "");
  EXPECT_EQ(nearest_name("", known), "");
  EXPECT_EQ(nearest_name("map", {}), "");
}

TEST(NearestName, TakesTheFirstOfEquallyNearNames) {
  constexpr std::array<std::string_view, 2> names = {"cart", "card"};
  EXPECT_EQ(nearest_name("carx", names), "cart");
}

TEST(NearestName, EndsAMessageWithASuggestionOrNothing) {
  EXPECT_EQ(did_you_mean("shape", known), ", did you mean 'shapes'?");
  EXPECT_EQ(did_you_mean("colour", known), "");
}

}  // namespace
}  // namespace waitpoint
