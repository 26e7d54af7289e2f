// SPDX-License-Identifier: BSD-3-Clause
#include "core/working_set.hpp"

#include <gtest/gtest.h>

#include <array>

namespace waitpoint {
namespace {

TEST(WorkingSet, NamesEveryLineThatSomethingLiesOn) {
  alignas(64) std::array<char, 256> memory{};
  const auto first = reinterpret_cast<std::uintptr_t>(memory.data()) / 64;
  WorkingSet set;
  set.add(memory.data() + 60, 5);  // across the end of a line
  set.add(memory.data() + 64, 64);
  set.add(memory.data(), 0);  // empty
  ASSERT_EQ(set.lines().size(), 2u);
  EXPECT_EQ(set.lines()[0].first, first);
  EXPECT_EQ(set.lines()[0].count, 2u);
  EXPECT_EQ(set.lines()[1].first, first + 1);
  EXPECT_EQ(set.lines()[1].count, 1u);
}

}  // namespace
}  // namespace waitpoint
