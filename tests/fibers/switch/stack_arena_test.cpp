// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/switch/stack_arena.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace waitpoint::kernel {
namespace {

constexpr StackSize sizes[] = {StackSize::small, StackSize::medium, StackSize::large};
constexpr std::size_t page = 4096;

TEST(StackArena, StacksAreAsLargeAsPromisedAndDoNotOverlap) {
  StackArena arena;
  std::vector<Stack> stacks(300);
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    ASSERT_TRUE(arena.take(sizes[i % 3], stacks[i]));
    const auto room = static_cast<std::size_t>(stacks[i].high - stacks[i].low);
    EXPECT_GE(room, bytes(sizes[i % 3]) - 2 * page);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(stacks[i].high) % 64, 0u);
    std::memset(stacks[i].low, static_cast<int>(i % 251), room);
  }
  for (std::size_t i = 0; i < stacks.size(); ++i)
    for (const char* at = stacks[i].low; at < stacks[i].high; at += 512)
      ASSERT_EQ(static_cast<unsigned char>(*at), i % 251);
}

TEST(StackArena, GivesTheStackLastGivenBackFirst) {
  StackArena arena;
  Stack a, b, c;
  ASSERT_TRUE(arena.take(StackSize::medium, a) && arena.take(StackSize::medium, b));
  ASSERT_NE(a.low, b.low);
  arena.give_back(a);
  arena.give_back(b);
  ASSERT_TRUE(arena.take(StackSize::medium, c));
  EXPECT_EQ(c.low, b.low);
  ASSERT_TRUE(arena.take(StackSize::medium, c));
  EXPECT_EQ(c.low, a.low);
  ASSERT_TRUE(arena.take(StackSize::medium, c));
  EXPECT_TRUE(c.low != a.low && c.low != b.low);
}

// Tops at one offset of their pages would share cache sets.
TEST(StackArena, TopsOfNeighboursLieAtDifferentOffsets) {
  StackArena arena;
  Stack a, b;
  ASSERT_TRUE(arena.take(StackSize::medium, a) && arena.take(StackSize::medium, b));
  EXPECT_NE(reinterpret_cast<std::uintptr_t>(a.high) % page, reinterpret_cast<std::uintptr_t>(b.high) % page);
}

TEST(StackArenaDeathTest, OverflowAtTheLowEndCrashes) {
  for (const StackSize size : sizes) {
    StackArena arena;
    Stack first, second;
    ASSERT_TRUE(arena.take(size, first) && arena.take(size, second));
    ASSERT_EQ(second.guard, Guard::page);
    EXPECT_EXIT(*static_cast<volatile char*>(first.low - 1) = 1, testing::KilledBySignal(SIGSEGV), "");
    EXPECT_EXIT(*static_cast<volatile char*>(second.low - page) = 1, testing::KilledBySignal(SIGSEGV), "");
    arena.give_back(second);
    ASSERT_TRUE(arena.take(size, second));
    EXPECT_EXIT(*static_cast<volatile char*>(second.low - 1) = 1, testing::KilledBySignal(SIGSEGV), "");
  }
}

// As on processors of ARM whose system has pages of 16 or 64 KiB.
TEST(StackArenaDeathTest, LargerPagesGuardTheStacksOfFourPagesAndMore) {
  for (const std::size_t larger_page : {std::size_t{16} << 10, std::size_t{64} << 10}) {
    for (const StackSize size : sizes) {
      StackArena arena(larger_page);
      Stack first, second;
      ASSERT_TRUE(arena.take(size, first) && arena.take(size, second));
      const Guard expected = bytes(size) >= 4 * larger_page ? Guard::page : Guard::canary;
      ASSERT_EQ(first.guard, expected);
      ASSERT_EQ(second.guard, expected);
      EXPECT_GE(static_cast<std::size_t>(second.high - second.low), bytes(size) / 2);
      std::memset(first.low + sizeof(std::uint64_t), 1, static_cast<std::size_t>(first.high - first.low) - 16);
      EXPECT_TRUE(StackArena::intact(first));
      if (expected == Guard::canary) continue;
      EXPECT_TRUE(StackArena::guards(second, second.low - larger_page));
      EXPECT_FALSE(StackArena::guards(second, second.low - larger_page - 1));
      EXPECT_EXIT(*static_cast<volatile char*>(second.low - 1) = 1, testing::KilledBySignal(SIGSEGV), "");
      EXPECT_EXIT(*static_cast<volatile char*>(second.low - larger_page) = 1, testing::KilledBySignal(SIGSEGV), "");
    }
  }
}

TEST(StackArenaDeathTest, ACanaryTellsWherePagesCannotBeGuarded) {
  StackArena arena;
  Stack stack;
  ASSERT_TRUE(arena.take(StackSize::small, stack));
  arena.give_back(stack);
  ASSERT_TRUE(arena.take(StackSize::small, stack));
  stack.guard = Guard::canary;
  EXPECT_FALSE(StackArena::intact(stack));
  EXPECT_DEATH(arena.give_back(stack), "ran over the end of its stack");
}

}  // namespace
}  // namespace waitpoint::kernel
