// SPDX-License-Identifier: BSD-3-Clause
// The exact slice, and the traversal of FCL's trees.
#include "tests/bench/world/contenders.hpp"
#include "world/fcl/mesh_tree.hpp"
#include "world/fcl/scene.hpp"
#include "world/mesh/band.hpp"
#include "world/slice/depth_buffer.hpp"
#include "world/slice/footprints.hpp"

namespace waitpoint::bench {
namespace {

world::Slice slice_of(const Place& place) {
  const world::Surfaces::Cut cut = world::Surfaces(place.meshes).cut(height_m);
  return world::Slice(place.obstacles, height_m, cut.segments, cut.meshes);
}

class BySlice : public Contender {
 public:
  explicit BySlice(const Place& place) : slice_(slice_of(place)), robots_(place.robots) {}

  void place(std::span<const world::Shape> robots) override {
    for (std::size_t i = 0; i < robots.size(); ++i) robots_.place(i, world::outline_of(robots[i]));
  }
  void scan(const Pose& at, std::uint32_t own, std::span<double, beams> ranges_m) override {
    const auto [s, c] = exact::sincos(at.heading);
    buffer_.begin({at.position(), {c, s}, exact::pi / (beams - 1), directions()}, range_max_m);
    buffer_.lower(slice_);
    buffer_.lower(robots_, height_m, own);
    std::copy(buffer_.ranges_m().begin(), buffer_.ranges_m().end(), ranges_m.begin());
  }

 private:
  world::Slice slice_;
  world::MovingSolids robots_;
  world::DepthBuffer buffer_;
};

class ByFclTrees : public Contender {
 public:
  explicit ByFclTrees(const Place& place)
      : obstacles_(place.obstacles), meshes_(place.meshes), robots_(place.robots, 0.4) {}

  void place(std::span<const world::Shape> robots) override {
    for (std::uint32_t i = 0; i < robots.size(); ++i) robots_.place(i, world::outline_of(robots[i]));
  }
  void scan(const Pose& at, std::uint32_t own, std::span<double, beams> ranges_m) override {
    const auto [s, c] = exact::sincos(at.heading);
    turned_.clear();
    for (const Point& d : directions()) turned_.push_back({c * d.x - s * d.y, s * d.x + c * d.y});
    std::fill(ranges_m.begin(), ranges_m.end(), range_max_m);
    obstacles_.cast(at.position(), turned_, height_m, world::Scene::none, ranges_m);
    meshes_.cast(at.position(), turned_, height_m, ranges_m);
    robots_.cast(at.position(), turned_, height_m, own, ranges_m);
  }

 private:
  world::Scene obstacles_;
  world::MeshTree meshes_;
  world::Scene robots_;
  std::vector<Point> turned_;
};

class ByFootprints : public Collider {
 public:
  explicit ByFootprints(const Place& place)
      : footprints_(place.obstacles), band_(world::Surfaces(place.meshes), robot_low_m, robot_high_m) {
    robot_.radius_m = robot_radius_m;
  }
  bool collides(Point centre) override {
    robot_.centre = centre;
    return footprints_.collides(robot_, robot_low_m, robot_high_m) || band_.collides(robot_);
  }

 private:
  world::Footprints footprints_;
  world::Band band_;
  world::Outline robot_;
};

}  // namespace

const std::vector<Point>& directions() {
  static const std::vector<Point> all = [] {
    std::vector<Point> made;
    for (std::size_t i = 0; i < beams; ++i) {
      const auto [s, c] = exact::sincos(-0.5 * exact::pi + static_cast<double>(i) * (exact::pi / (beams - 1)));
      made.push_back({c, s});
    }
    return made;
  }();
  return all;
}

std::unique_ptr<Collider> our_footprints(const Place& place) { return std::make_unique<ByFootprints>(place); }
std::unique_ptr<Contender> our_slice(const Place& place) { return std::make_unique<BySlice>(place); }
std::unique_ptr<Contender> our_fcl_trees(const Place& place) { return std::make_unique<ByFclTrees>(place); }

}  // namespace waitpoint::bench
