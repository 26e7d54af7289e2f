// SPDX-License-Identifier: BSD-3-Clause
// The overlap query on a tree of rectangles, in floats.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "core/error.hpp"
#include "world/slice/kernels.hpp"

namespace waitpoint::world {

/// Calls `visit(solid)` for the solids whose rectangles overlap `bounds` grown by `margin_m`, until it returns false.
/// `bounds` is in the tree's coordinates; `margin_m` must exceed the rounding to float. The root is the first node.
template <class Visit>
void walk_overlapping(std::span<const TreeNode> nodes, const Bounds& bounds, double margin_m, const Kernels& kernels,
                      Visit visit) {
  if (nodes.empty()) return;
  const Bounds b = bounds.grown(margin_m);
  // Overflow to an infinite float is harmless: bounds so far outside the tree overlap nothing in either case.
  const FloatBounds wanted = {static_cast<float>(b.low.x), static_cast<float>(b.low.y), static_cast<float>(b.high.x),
                              static_cast<float>(b.high.y)};
  std::array<std::int32_t, 512> pending;
  std::size_t count = 0;
  pending[count++] = 0;
  while (count > 0) {
    const auto at = static_cast<std::size_t>(pending[--count]);
    WAITPOINT_FAST_CHECK(at < nodes.size(), "a node's child is beyond the end of the tree");
    const TreeNode& node = nodes[at];
    for (unsigned met = kernels.overlap(node.bounds, wanted); met != 0; met &= met - 1) {
      const std::int32_t child = node.child[static_cast<std::size_t>(std::countr_zero(met))];
      if (child >= 0) {
        WAITPOINT_CHECK(count < pending.size(), "a tree of solids far out of balance");
        pending[count++] = child;
      } else if (!visit(static_cast<std::uint32_t>(~child))) {
        return;
      }
    }
  }
}

}  // namespace waitpoint::world
