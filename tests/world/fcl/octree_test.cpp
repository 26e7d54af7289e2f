// SPDX-License-Identifier: BSD-3-Clause
// The boxes of an octree against the same tree in FCL's own narrow phase.
#include <fcl/config.h>
#include <gtest/gtest.h>
#include <octomap/octomap.h>

#include <cmath>
#include <sstream>

#include "tests/world/placements.hpp"
#include "tests/world/scenes.hpp"
#include "world/formats/octree.hpp"
#include "world/planar/separation.hpp"
#include "world/slice/footprints.hpp"

#if FCL_HAVE_OCTOMAP
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/narrowphase/collision.h>

namespace waitpoint::world {
namespace {

// Random placements near one tree; counts those that collide and those that do not.
void compare(std::uint64_t seed, int placements, long& together, long& apart) {
  Draws draw(seed);
  const auto tree = std::make_shared<octomap::OcTree>(0.1);
  for (int i = 0; i < 400; ++i)
    tree->updateNode(octomap::point3d(static_cast<float>(draw(-2, 2)), static_cast<float>(draw(-2, 2)),
                                      static_cast<float>(draw(0, 1))),
                     true);
  tree->prune();
  std::ostringstream out;
  tree->writeBinary(out);
  const std::vector<Shape> boxes = parse_octree(out.str(), "t.bt");
  const Footprints footprints(boxes);
  const fcl::CollisionObjectd cells(std::make_shared<fcl::OcTreed>(tree));
  for (int k = 0; k < placements; ++k) {
    const double half_height_m = draw(0.02, 0.2), z_m = draw(-0.2, 1.2), radius_m = draw(0.02, 0.15);
    const Point at = {draw(-2, 2), draw(-2, 2)};
    const Outline outline = outline_of(cylinder(at, radius_m));
    const double low_m = z_m - half_height_m, high_m = z_m + half_height_m;
    const auto touches_within = [&](double margin_m) {
      const Outline other = outline_of(cylinder(at, radius_m + margin_m));
      return footprints.collides(other, low_m - margin_m, high_m + margin_m);
    };
    const bool meets = footprints.collides(outline, low_m, high_m);
    if (touches_within(1e-6) != meets || touches_within(-1e-6) != meets) continue;
    fcl::Transform3d there = fcl::Transform3d::Identity();
    there.translation() << at.x, at.y, z_m;
    const fcl::CollisionObjectd probe(std::make_shared<fcl::Cylinderd>(radius_m, 2 * half_height_m), there);
    fcl::CollisionResultd result;
    ASSERT_EQ(fcl::collide(&cells, &probe, fcl::CollisionRequestd(), result) > 0, meets) << seed << " " << k;
    ++(meets ? together : apart);
  }
}

TEST(Octree, CollidesWhereFclsDoes) {
  const long wanted = placements(100'000);
  long apart = 0, together = 0;
  for (std::uint64_t seed = 1; apart + together < wanted && !HasFatalFailure(); ++seed)
    compare(seed, 10'000, together, apart);
  EXPECT_GT(apart, wanted / 5);
  EXPECT_GT(together, wanted / 5);
}

}  // namespace
}  // namespace waitpoint::world
#endif
