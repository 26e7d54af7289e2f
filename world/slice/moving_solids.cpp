// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/moving_solids.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "core/error.hpp"
#include "world/slice/overlap_walk.hpp"

namespace waitpoint::world {
namespace {

constexpr std::size_t width = EightBounds::width;
constexpr double spread_more = 1.5;

FloatBounds united(const TreeNode& node) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  FloatBounds all = {infinity, infinity, -infinity, -infinity};
  for (std::size_t i = 0; i < width && node.child[i] != TreeNode::none; ++i) {
    all.low_x = std::min(all.low_x, node.bounds.low_x[i]);
    all.low_y = std::min(all.low_y, node.bounds.low_y[i]);
    all.high_x = std::max(all.high_x, node.bounds.high_x[i]);
    all.high_y = std::max(all.high_y, node.bounds.high_y[i]);
  }
  return all;
}

}  // namespace

MovingSolids::MovingSolids(std::span<const Shape> shapes, std::uint32_t first_solid)
    : first_solid_(first_solid), polygons_(polygons_of(shapes)) {
  for (const Shape& shape : shapes) solids_.push_back({outline_of(shape), shape.z_low_m, shape.z_high_m, 0});
  if (solids_.empty()) return;
  std::vector<std::size_t> counts = {(solids_.size() + width - 1) / width};
  while (counts.back() > 1) counts.push_back((counts.back() + width - 1) / width);
  std::size_t nodes = 0;
  for (auto count = counts.rbegin(); count != counts.rend(); ++count) {
    levels_.push_back(nodes);
    nodes += *count;
  }
  WAITPOINT_CHECK(nodes < static_cast<std::size_t>(TreeNode::none) && counts.back() == 1,
                  "a tree of moving solids has no single root, or more nodes than 32-bit indices allow");
  nodes_.assign(nodes, TreeNode::empty());
  for (std::size_t level = 0; level + 1 < levels_.size(); ++level) {
    const std::size_t below = level + 2 < levels_.size() ? levels_[level + 2] : nodes;
    for (std::size_t child = levels_[level + 1]; child < below; ++child) {
      const std::size_t number = child - levels_[level + 1];
      nodes_[levels_[level] + number / width].child[number % width] = static_cast<std::int32_t>(child);
    }
  }
  order();
}

// Orders a group by recursive halving along its longer side; the first part fills a complete subtree.
void MovingSolids::order(std::span<std::uint32_t> group) const {
  const std::size_t leaves = (group.size() + width - 1) / width;
  if (leaves < 2) return;
  const auto middle = [this](std::uint32_t solid) { return solids_[solid].outline.centre; };
  Bounds around = {middle(group[0]), middle(group[0])};
  for (const std::uint32_t solid : group) {
    const Point p = middle(solid);
    around = {{std::min(around.low.x, p.x), std::min(around.low.y, p.y)},
              {std::max(around.high.x, p.x), std::max(around.high.y, p.y)}};
  }
  const bool by_x = around.high.x - around.low.x >= around.high.y - around.low.y;
  const std::size_t first = std::bit_ceil(leaves) / 2 * width;
  WAITPOINT_CHECK(0 < first && first < group.size(), "a division of moving solids leaves one side empty");
  std::nth_element(group.begin(), group.begin() + static_cast<std::ptrdiff_t>(first), group.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const Point p = middle(a), q = middle(b);
                     return by_x ? std::tie(p.x, a) < std::tie(q.x, b) : std::tie(p.y, a) < std::tie(q.y, b);
                   });
  order(group.first(first));
  order(group.subspan(first));
}

void MovingSolids::order() {
  std::vector<std::uint32_t> all(solids_.size());
  std::iota(all.begin(), all.end(), std::uint32_t{0});
  order(all);
  for (std::uint32_t place = 0; place < all.size(); ++place) {
    solids_[all[place]].place = place;
    nodes_[levels_.back() + place / width].child[place % width] = ~static_cast<std::int32_t>(all[place]);
    set_leaf(all[place]);
  }
  for (std::size_t level = levels_.size() - 1; level > 0; --level) {
    const std::size_t end = level + 1 < levels_.size() ? levels_[level + 1] : nodes_.size();
    for (std::size_t node = levels_[level]; node < end; ++node) set_above(level, node);
  }
  WAITPOINT_FAST_CHECK(is_consistent(), "the tree of moving solids disagrees with its solids");
  ordered_spread_m_ = spread_m();
  placed_ = 0;
}

// True if every solid is in the leaf of its place, and every node's rectangle in its parent is the union of its own.
bool MovingSolids::is_consistent() const {
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    const std::size_t place = solids_[i].place;
    if (place >= solids_.size()) return false;
    if (nodes_[levels_.back() + place / width].child[place % width] != ~static_cast<std::int32_t>(i)) return false;
  }
  for (const TreeNode& node : nodes_) {
    for (std::size_t i = 0; i < width && node.child[i] != TreeNode::none; ++i) {
      if (node.child[i] < 0) continue;
      const FloatBounds all = united(nodes_[static_cast<std::size_t>(node.child[i])]);
      if (all.low_x != node.bounds.low_x[i] || all.low_y != node.bounds.low_y[i] ||
          all.high_x != node.bounds.high_x[i] || all.high_y != node.bounds.high_y[i])
        return false;
    }
  }
  return true;
}

void MovingSolids::set_leaf(std::size_t at) {
  const Bounds b = bounds_of(solids_[at].outline);
  WAITPOINT_FAST_CHECK(
      std::isfinite(b.low.x) && std::isfinite(b.low.y) && std::isfinite(b.high.x) && std::isfinite(b.high.y),
      "a moving solid's bounds are not finite");
  WAITPOINT_FAST_CHECK(b.low.x <= b.high.x && b.low.y <= b.high.y, "a moving solid's bounds end before they begin");
  const double farthest = std::max({std::fabs(b.low.x), std::fabs(b.low.y), std::fabs(b.high.x), std::fabs(b.high.y)});
  extent_m_ = std::max(extent_m_, farthest);
  const std::size_t place = solids_[at].place;
  nodes_[levels_.back() + place / width].bounds.set(static_cast<int>(place % width), b, {0, 0},
                                                    float_margin_m(farthest));
}

// Updates the node's rectangle in its parent; true if it changed.
bool MovingSolids::set_above(std::size_t level, std::size_t node) {
  WAITPOINT_FAST_CHECK(0 < level && level < levels_.size() && levels_[level] <= node && node < nodes_.size(),
                       "a node of moving solids is not in its level");
  const std::size_t number = node - levels_[level], i = number % width;
  EightBounds& above = nodes_[levels_[level - 1] + number / width].bounds;
  const FloatBounds all = united(nodes_[node]);
  if (all.low_x == above.low_x[i] && all.low_y == above.low_y[i] && all.high_x == above.high_x[i] &&
      all.high_y == above.high_y[i])
    return false;
  above.low_x[i] = all.low_x;
  above.low_y[i] = all.low_y;
  above.high_x[i] = all.high_x;
  above.high_y[i] = all.high_y;
  return true;
}

// The sum of the half perimeters of the lowest nodes.
double MovingSolids::spread_m() const {
  double sum = 0;
  if (levels_.size() < 2) return sum;
  for (std::size_t node = levels_[levels_.size() - 2]; node < levels_.back(); ++node) {
    const TreeNode& above = nodes_[node];
    for (std::size_t i = 0; i < width && above.child[i] != TreeNode::none; ++i)
      sum += static_cast<double>((above.bounds.high_x[i] - above.bounds.low_x[i]) +
                                 (above.bounds.high_y[i] - above.bounds.low_y[i]));
  }
  return sum;
}

void MovingSolids::place(std::size_t at, const Outline& outline) {
  WAITPOINT_FAST_CHECK(at < solids_.size(), "a moving solid that does not exist is placed");
  solids_[at].outline = outline;
  set_leaf(at);
  std::size_t number = solids_[at].place / width;
  for (std::size_t level = levels_.size() - 1; level > 0; --level, number /= width)
    if (!set_above(level, levels_[level] + number)) break;
  if (++placed_ < solids_.size()) return;
  placed_ = 0;
  if (spread_m() > spread_more * ordered_spread_m_) order();
}

void MovingSolids::place(std::size_t at, const Outline& outline, double z_low_m, double z_high_m) {
  WAITPOINT_FAST_CHECK(at < solids_.size() && z_low_m <= z_high_m,
                       "a moving solid that does not exist is placed, or it ends below its lower face");
  solids_[at].z_low_m = z_low_m;
  solids_[at].z_high_m = z_high_m;
  place(at, outline);
}

void MovingSolids::list_by_leaves(std::vector<std::uint32_t>& places) const {
  places.clear();
  if (levels_.empty()) return;
  for (std::size_t node = levels_.back(); node < nodes_.size(); ++node)
    for (std::size_t i = 0; i < width && nodes_[node].child[i] != TreeNode::none; ++i)
      places.push_back(static_cast<std::uint32_t>(~nodes_[node].child[i]));
}

void MovingSolids::near(const Bounds& bounds, std::vector<std::uint32_t>& found, const Kernels& of) const {
  found.clear();
  walk_overlapping(nodes_, bounds, float_margin_m(extent_m_), of, [&](std::uint32_t at) {
    found.push_back(at);
    return true;
  });
  std::sort(found.begin(), found.end());
}

}  // namespace waitpoint::world
