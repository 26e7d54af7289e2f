// SPDX-License-Identifier: BSD-3-Clause
#include "world/fcl/scene.hpp"

#include <fcl/broadphase/detail/hierarchy_tree.h>
#include <fcl/narrowphase/collision.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/error.hpp"
#include "world/fcl/geometry.hpp"
#include "world/fcl/wedge.hpp"

namespace waitpoint::world {
namespace {

// With another alignment of Eigen's types than Debian's libfcl was built with, calls into it corrupt memory.
static_assert(sizeof(fcl::CollisionObjectd) == 224, "Eigen is aligned differently in the FCL library");

using Node = fcl::detail::NodeBase<fcl::AABBd>;

constexpr double padding_m = Scene::padding_m;

// Maintenance as in FCL's own manager: the tree is improved a little after each update, and rebuilt if it is this much
// higher than necessary. (The manager measures the height at each update, which for thousands of solids takes a
// thousand times longer than the update.)
constexpr int better_by = 10;
constexpr std::size_t higher_max = 10;

class Solid : public fcl::CollisionObjectd {
 public:
  Solid(const Shape& shape, std::uint32_t number)
      : fcl::CollisionObjectd(geometry_of(shape)),
        outline(outline_of(shape)),
        z_low_m(shape.z_low_m),
        z_high_m(shape.z_high_m),
        number(number),
        polygon_(shape.polygon) {
    settle();
  }

  // Brings FCL's transform up to date.
  void settle() {
    setTransform(transform_of(outline, z_low_m, z_high_m));
    unsettled = false;
  }
  bool reaches(double height_m) const { return z_low_m <= height_m && height_m <= z_high_m; }

  // FCL's own bounds of a rotated box are those of its circumscribed sphere, which for walls are far too wide.
  void set_bounds(const Bounds& b) {
    aabb = fcl::AABBd(fcl::Vector3d(b.low.x, b.low.y, z_low_m - padding_m),
                      fcl::Vector3d(b.high.x, b.high.y, z_high_m + padding_m));
  }
  bool has_heights() const { return aabb.min_[2] == z_low_m - padding_m && aabb.max_[2] == z_high_m + padding_m; }
  Bounds bounds() const { return {{aabb.min_[0], aabb.min_[1]}, {aabb.max_[0], aabb.max_[1]}}; }

  Outline outline;
  double z_low_m, z_high_m;
  std::uint32_t number;
  bool unsettled = false;
  Node* leaf = nullptr;

 private:
  std::shared_ptr<const ConvexPolygon> polygon_;  // the outline's
};

const Solid& solid_in(const Node* leaf) {
  return *static_cast<const Solid*>(static_cast<const fcl::CollisionObjectd*>(leaf->data));
}

// The nodes left to visit. FCL keeps its trees balanced to within ten levels; an overflow is a bug.
template <class Item>
class Stack {
 public:
  bool empty() const { return size_ == 0; }
  void push(const Item& item) {
    WAITPOINT_CHECK(size_ < items_.size(), "a tree of bounding boxes far out of balance");
    items_[size_++] = item;
  }
  Item pop() {
    WAITPOINT_FAST_CHECK(size_ > 0, "a walk continues with no node left");
    return items_[--size_];
  }

 private:
  std::array<Item, 256> items_;
  std::size_t size_ = 0;
};

struct PendingNode {
  const Node* node;
  double entry_m2;
};

}  // namespace

struct Scene::Trees {
  double margin_m;
  std::vector<std::unique_ptr<Solid>> solids;
  fcl::detail::HierarchyTree<fcl::AABBd> tree;
  std::size_t updates = 0;
  std::vector<std::uint32_t> unsettled;  // placed, but not yet updated in the tree

  const Node* root() const { return tree.getRoot(); }

  /// Brings the tree up to date; called by queries, so a scene without queries costs nothing.
  void settle() {
    for (const std::uint32_t number : unsettled) {
      Solid& solid = *solids[number];
      solid.settle();
      const Bounds bounds = bounds_of(solid.outline);
      if (solid.has_heights() && solid.bounds().contains(bounds.grown(padding_m))) continue;
      solid.set_bounds(bounds.grown(margin_m));
      WAITPOINT_FAST_CHECK(solid.has_heights() && solid.bounds().contains(bounds.grown(padding_m)),
                           "a solid's box is smaller than the solid");
      update(solid);
    }
    unsettled.clear();
  }

  void grow(std::span<const Shape> shapes) {
    WAITPOINT_CHECK(shapes.size() < none && margin_m >= padding_m, "a scene has too many solids, or too narrow boxes");
    std::vector<Node*> leaves;
    for (const Shape& shape : shapes) {
      WAITPOINT_CHECK(shape.z_low_m <= shape.z_high_m, "a solid ends below its lower face");
      auto solid = std::make_unique<Solid>(shape, static_cast<std::uint32_t>(solids.size()));
      solid->set_bounds(bounds_of(solid->outline).grown(margin_m));
      solid->leaf = leaves.emplace_back(new Node);  // owned by the tree
      solid->leaf->bv = solid->getAABB();
      solid->leaf->parent = nullptr;
      solid->leaf->children[1] = nullptr;
      solid->leaf->data = static_cast<fcl::CollisionObjectd*>(solid.get());
      solids.push_back(std::move(solid));
    }
    if (!leaves.empty()) tree.init(leaves);
  }

  void update(const Solid& solid) {
    WAITPOINT_FAST_CHECK(&solid_in(solid.leaf) == &solid, "a solid's leaf is another's");
    tree.update(solid.leaf, solid.getAABB());
    tree.balanceIncremental(better_by);
    if (++updates < solids.size()) return;
    updates = 0;
    if (tree.getMaxHeight() >= static_cast<std::size_t>(std::bit_width(solids.size())) + higher_max)
      tree.balanceTopdown();
  }

  void cast(Point origin, std::span<const Point> directions, double height_m, std::uint32_t except,
            std::span<double> ranges_m) const {
    const Wedge wedge = {origin, directions.front(), directions.back()};
    double limit_m2 = farthest_m2(ranges_m);
    Stack<PendingNode> pending;
    pending.push({root(), 0});
    while (!pending.empty()) {
      auto [node, entry_m2] = pending.pop();
      if (entry_m2 > limit_m2) continue;
      while (node != nullptr && !node->isLeaf()) {
        const Node *near = node->children[0], *far = node->children[1];
        double near_m2 = wedge.entry(near->bv), far_m2 = wedge.entry(far->bv);
        if (far_m2 < near_m2) {
          std::swap(near, far);
          std::swap(near_m2, far_m2);
        }
        if (far_m2 <= limit_m2) pending.push({far, far_m2});
        node = near_m2 <= limit_m2 ? near : nullptr;
      }
      if (node == nullptr) continue;
      const Solid& solid = solid_in(node);
      if (solid.number == except || !solid.reaches(height_m)) continue;
      for (std::size_t i = 0; i < directions.size(); ++i) {
        ranges_m[i] = std::min(ranges_m[i], hit_distance(solid.outline, {origin, directions[i]}));
      }
      limit_m2 = farthest_m2(ranges_m);
    }
  }
};

Scene::Scene(std::span<const Shape> shapes, double roam_m) : trees_(std::make_unique<Trees>()) {
  trees_->margin_m = roam_m + padding_m;
  trees_->grow(shapes);
}

Scene::~Scene() = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;

std::uint32_t Scene::size() const { return static_cast<std::uint32_t>(trees_->solids.size()); }
const Outline& Scene::outline(std::uint32_t solid) const { return trees_->solids[solid]->outline; }
bool Scene::reaches(std::uint32_t solid, double height_m) const { return trees_->solids[solid]->reaches(height_m); }

void Scene::place(std::uint32_t solid, const Outline& outline) {
  const Solid& s = *trees_->solids[solid];
  place(solid, outline, s.z_low_m, s.z_high_m);
}

void Scene::place(std::uint32_t solid, const Outline& outline, double z_low_m, double z_high_m) {
  WAITPOINT_FAST_CHECK(solid < size() && z_low_m <= z_high_m,
                       "a solid that does not exist is placed, or it ends below its lower face");
  Solid& s = *trees_->solids[solid];
  s.z_low_m = z_low_m;
  s.z_high_m = z_high_m;
  s.outline = outline;
  if (s.unsettled) return;
  s.unsettled = true;
  trees_->unsettled.push_back(solid);
}

void Scene::near(const Bounds& bounds, double z_low_m, double z_high_m, std::vector<std::uint32_t>& found) const {
  found.clear();
  if (trees_->solids.empty()) return;
  trees_->settle();
  Stack<const Node*> pending;
  pending.push(trees_->root());
  while (!pending.empty()) {
    const Node* node = pending.pop();
    const fcl::AABBd& box = node->bv;
    if (!bounds.overlaps({{box.min_[0], box.min_[1]}, {box.max_[0], box.max_[1]}})) continue;
    if (!node->isLeaf()) {
      pending.push(node->children[0]);
      pending.push(node->children[1]);
    } else if (const Solid& s = solid_in(node); s.z_low_m < z_high_m && z_low_m < s.z_high_m) {
      found.push_back(s.number);
    }
  }
  std::sort(found.begin(), found.end());
}

void Scene::cast(Point origin, std::span<const Point> directions, double height_m, std::uint32_t except,
                 std::span<double> ranges_m) const {
  WAITPOINT_CHECK(directions.size() == ranges_m.size(), "there are not as many directions as ranges");
  if (trees_->solids.empty()) return;
  trees_->settle();
  for_each_wedge(directions, [&](std::size_t first, std::size_t count) {
    trees_->cast(origin, directions.subspan(first, count), height_m, except, ranges_m.subspan(first, count));
  });
}

bool Scene::collides(const Shape& shape) const {
  Solid probe(shape, none);
  std::vector<std::uint32_t> candidates;
  near(bounds_of(probe.outline).grown(padding_m), shape.z_low_m - padding_m, shape.z_high_m + padding_m, candidates);
  return std::any_of(candidates.begin(), candidates.end(), [&](std::uint32_t solid) {
    fcl::CollisionResultd result;
    return fcl::collide(&probe, trees_->solids[solid].get(), fcl::CollisionRequestd(), result) > 0;
  });
}

}  // namespace waitpoint::world
