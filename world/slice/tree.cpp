// SPDX-License-Identifier: BSD-3-Clause
#include "world/slice/tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "core/error.hpp"

namespace waitpoint::world {
namespace {

// Below this level solids are halved by number, which bounds the depth for every arrangement.
constexpr int swept_levels_max = 48;
// The binary tree has less than twice as many parts.
constexpr std::size_t solids_max = std::size_t{1} << 30;

Bounds united(const Bounds& a, const Bounds& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

double half_perimeter(const Bounds& b) { return (b.high.x - b.low.x) + (b.high.y - b.low.y); }

bool is_finite(const Bounds& b) {
  return std::isfinite(b.low.x) && std::isfinite(b.low.y) && std::isfinite(b.high.x) && std::isfinite(b.high.y);
}

bool contains(const EightBounds& outer, std::size_t lane, const EightBounds& inner, std::size_t inner_lane) {
  return outer.low_x[lane] <= inner.low_x[inner_lane] && outer.low_y[lane] <= inner.low_y[inner_lane] &&
         outer.high_x[lane] >= inner.high_x[inner_lane] && outer.high_y[lane] >= inner.high_y[inner_lane];
}

}  // namespace

EightBounds EightBounds::nowhere() {
  // The square of the distance overflows to infinity.
  constexpr float far = 1e30f;
  EightBounds bounds;
  for (float* side : {bounds.low_x, bounds.low_y, bounds.high_x, bounds.high_y}) std::fill_n(side, width, far);
  return bounds;
}

void EightBounds::set(int at, const Bounds& bounds, Point middle, double margin_m) {
  const Bounds b = Bounds{bounds.low - middle, bounds.high - middle}.grown(margin_m);
  low_x[at] = static_cast<float>(b.low.x);
  low_y[at] = static_cast<float>(b.low.y);
  high_x[at] = static_cast<float>(b.high.x);
  high_y[at] = static_cast<float>(b.high.y);
}

TreeNode TreeNode::empty() {
  TreeNode node = {EightBounds::nowhere(), {}};
  node.child.fill(none);
  return node;
}

// A part of the binary tree: one solid, or two parts. It may take k of a node's eight children: as one node, or divided
// between its left and right parts; `perimeters_m[k]` is the least sum of the perimeters of the nodes within it.
// (Ylitie, Karras, Laine, "Efficient Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", HPG 2017.)
struct Part {
  Bounds bounds;
  std::int32_t left = 0, right = 0;  // indices of parts; a solid has ~number in `left`
  std::array<float, EightBounds::width + 1> perimeters_m{};
  std::array<std::uint8_t, EightBounds::width + 1> to_left{};  // of k children, those of the left part; 0: one node
  std::uint8_t to_left_as_node = 0;                            // the same of its own eight children

  bool is_solid() const { return left < 0; }
};

struct Tree::Builder {
  using Group = std::span<std::uint32_t>;

  Tree& tree;
  std::span<const Bounds> solids;
  std::vector<Part> parts = {};
  std::vector<double> perimeters = {};  // half perimeter of the right side, by the place of the division

  Bounds bounds(Group group) const {
    Bounds all = solids[group.front()];
    for (const std::uint32_t solid : group) all = united(all, solids[solid]);
    return all;
  }

  void sort(Group group, bool by_x) const {
    std::sort(group.begin(), group.end(), [&](std::uint32_t a, std::uint32_t b) {
      const Bounds &p = solids[a], &q = solids[b];
      const double at_p = by_x ? p.low.x + p.high.x : p.low.y + p.high.y;
      const double at_q = by_x ? q.low.x + q.high.x : q.low.y + q.high.y;
      return std::tie(at_p, a) < std::tie(at_q, b);
    });
  }

  /// The cost of the best division of the sorted group, and the size of its first part. Of equal costs the most even.
  std::pair<double, std::size_t> best_division(Group group) {
    const std::size_t n = group.size();
    perimeters.resize(n);
    Bounds right = solids[group.back()];
    for (std::size_t i = n - 1; i > 0; --i) {
      right = united(right, solids[group[i]]);
      perimeters[i] = half_perimeter(right);
    }
    const auto unevenness = [n](std::size_t i) { return i > n - i ? i - (n - i) : n - i - i; };
    std::pair<double, std::size_t> best = {std::numeric_limits<double>::infinity(), n / 2};
    Bounds left = solids[group.front()];
    for (std::size_t i = 1; i < n; ++i) {
      left = united(left, solids[group[i - 1]]);
      const double cost = half_perimeter(left) * static_cast<double>(i) + perimeters[i] * static_cast<double>(n - i);
      if (cost < best.first || (cost == best.first && unevenness(i) < unevenness(best.second))) best = {cost, i};
    }
    return best;
  }

  std::size_t divide(Group group, int level) {
    if (level > swept_levels_max) return group.size() / 2;
    sort(group, false);
    const auto by_y = best_division(group);
    sort(group, true);
    const auto by_x = best_division(group);
    if (by_x.first <= by_y.first) return by_x.second;
    sort(group, false);
    return by_y.second;
  }

  std::int32_t halve(Group group, int level) {
    const std::size_t number = parts.size();
    parts.push_back({bounds(group)});
    if (group.size() == 1) {
      parts.back().left = ~static_cast<std::int32_t>(group.front());
      return static_cast<std::int32_t>(number);
    }
    const std::size_t first = divide(group, level);
    WAITPOINT_CHECK(0 < first && first < group.size(), "a division of a tree leaves one side empty");
    const std::int32_t left = halve(group.first(first), level + 1), right = halve(group.subspan(first), level + 1);
    parts[number].left = left;
    parts[number].right = right;
    WAITPOINT_CHECK(number < static_cast<std::size_t>(left) && left < right, "a tree's parts come after their whole");
    share_children(parts[number]);
    return static_cast<std::int32_t>(number);
  }

  const Part& part(std::int32_t number) const { return parts[static_cast<std::size_t>(number)]; }

  void share_children(Part& whole) const {
    constexpr std::size_t width = EightBounds::width;
    const Part &left = part(whole.left), &right = part(whole.right);
    for (std::size_t k = 2; k <= width; ++k) {
      whole.perimeters_m[k] = std::numeric_limits<float>::infinity();
      for (std::size_t a = 1; a < k; ++a) {
        const float sum_m = left.perimeters_m[a] + right.perimeters_m[k - a];
        if (!(sum_m < whole.perimeters_m[k])) continue;
        whole.perimeters_m[k] = sum_m;
        whole.to_left[k] = static_cast<std::uint8_t>(a);
      }
    }
    whole.to_left_as_node = whole.to_left[width];
    whole.perimeters_m[1] = static_cast<float>(half_perimeter(whole.bounds)) + whole.perimeters_m[width];
    for (std::size_t k = 2; k <= width; ++k) {
      if (whole.perimeters_m[1] > whole.perimeters_m[k]) continue;
      whole.perimeters_m[k] = whole.perimeters_m[1];
      whole.to_left[k] = 0;
    }
  }

  /// Appends the parts that replace this one as children, at most `most`.
  void take(std::int32_t number, std::size_t most, std::vector<std::int32_t>& children) const {
    const Part& p = part(number);
    const std::size_t to_left = p.is_solid() || most == 1 ? 0 : p.to_left[most];
    if (to_left == 0) return children.push_back(number);
    take(p.left, to_left, children);
    take(p.right, most - to_left, children);
  }

  std::int32_t build(std::int32_t number, int level) {
    const std::size_t at = tree.nodes_.size();
    tree.nodes_.emplace_back();
    tree.depth_ = std::max(tree.depth_, level + 1);
    std::vector<std::int32_t> children;
    if (const Part& whole = part(number); whole.is_solid()) {
      children.push_back(number);
    } else {
      take(whole.left, whole.to_left_as_node, children);
      take(whole.right, EightBounds::width - whole.to_left_as_node, children);
    }
    WAITPOINT_CHECK(!children.empty() && children.size() <= EightBounds::width, "a tree's node has 1 to 8 children");
    TreeNode node = TreeNode::empty();
    for (std::size_t i = 0; i < children.size(); ++i) {
      const Part& child = part(children[i]);
      node.bounds.set(static_cast<int>(i), child.bounds, tree.middle_, float_margin_m(tree.extent_m_));
      node.child[i] = child.is_solid() ? child.left : build(children[i], level + 1);
    }
    tree.nodes_[at] = node;
    return static_cast<std::int32_t>(at);
  }
};

std::vector<std::uint32_t> Tree::number_by_nodes() {
  std::vector<std::uint32_t> before;
  for (TreeNode& node : nodes_) {
    for (std::int32_t& child : node.child) {
      if (child >= 0) continue;
      before.push_back(static_cast<std::uint32_t>(~child));
      child = ~static_cast<std::int32_t>(before.size() - 1);
    }
  }
  WAITPOINT_FAST_CHECK(std::set<std::uint32_t>(before.begin(), before.end()).size() == before.size(),
                       "two solids of a tree had one number");
  return before;
}

Tree::Tree(std::span<const Bounds> solids) {
  if (solids.empty()) return;
  std::vector<std::uint32_t> all(solids.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  WAITPOINT_CHECK(solids.size() <= solids_max, "a tree has more solids than 32-bit indices of its parts allow");
  for (const Bounds& b : solids) {
    WAITPOINT_CHECK(is_finite(b), "a solid's bounds are not finite");
    WAITPOINT_CHECK(b.low.x <= b.high.x && b.low.y <= b.high.y, "a solid's bounds end before they begin");
  }
  Builder builder{*this, solids};
  const Bounds around = builder.bounds(all);
  middle_ = 0.5 * (around.low + around.high);
  extent_m_ = std::max(around.high.x - middle_.x, around.high.y - middle_.y);
  builder.build(builder.halve(all, 0), 0);
  check(solids.size());
}

// The invariants of the nodes; in the time of one walk, which is far less than the sweeps take.
void Tree::check(std::size_t solids) const {
  constexpr std::size_t width = EightBounds::width;
  const EightBounds nowhere = EightBounds::nowhere();
  std::vector<bool> is_leaf(solids);
  std::size_t leaves = 0, inner = 0;
  for (std::size_t at = 0; at < nodes_.size(); ++at) {
    const auto& [bounds, children] = nodes_[at];
    WAITPOINT_CHECK(children[0] != TreeNode::none, "a tree's node has no child");
    for (std::size_t i = 0; i < width; ++i) {
      if (children[i] == TreeNode::none) {
        WAITPOINT_CHECK(contains(bounds, i, nowhere, i) && contains(nowhere, i, bounds, i),
                        "an unused lane of a tree's node has a rectangle");
        continue;
      }
      WAITPOINT_CHECK(i == 0 || children[i - 1] != TreeNode::none, "an unused lane lies between a node's children");
      if (children[i] < 0) {
        const auto solid = static_cast<std::size_t>(~children[i]);
        WAITPOINT_CHECK(solid < solids && !is_leaf[solid], "a solid is in a tree twice, or was not given to it");
        is_leaf[solid] = true;
        ++leaves;
        continue;
      }
      const auto child = static_cast<std::size_t>(children[i]);
      WAITPOINT_CHECK(at < child && child < nodes_.size(), "a tree's node does not come before its child");
      ++inner;
      for (std::size_t j = 0; j < width && nodes_[child].child[j] != TreeNode::none; ++j)
        WAITPOINT_CHECK(contains(bounds, i, nodes_[child].bounds, j),
                        "a node's rectangle does not contain its child's");
    }
  }
  WAITPOINT_CHECK(leaves == solids, "a tree has lost a solid");
  WAITPOINT_CHECK(inner + 1 == nodes_.size(), "a node of a tree is not the child of exactly one other");
}

}  // namespace waitpoint::world
