// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/heap_pages.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace waitpoint::bridge {
namespace {

// As much as a crowd's, in pieces that come from the heap.
TEST(HeapPages, WhatWasAllocatedStaysAsItWas) {
  using Piece = std::array<std::uint64_t, 4096>;
  std::vector<std::unique_ptr<Piece>> pieces;
  for (std::uint64_t i = 0; i < 1200; ++i) {
    pieces.push_back(std::make_unique<Piece>());
    for (std::uint64_t k = 0; k < 4096; ++k) (*pieces.back())[k] = i * 4096 + k;
  }
  for (int times = 0; times < 2; ++times) put_heap_on_large_pages();
  for (std::uint64_t i = 0; i < 1200; ++i)
    for (std::uint64_t k = 0; k < 4096; ++k) ASSERT_EQ((*pieces[i])[k], i * 4096 + k);
  auto later = std::make_unique<Piece>();
  later->fill(7);
  EXPECT_EQ(later->back(), 7u);
}

}  // namespace
}  // namespace waitpoint::bridge
