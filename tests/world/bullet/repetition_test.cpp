// SPDX-License-Identifier: BSD-3-Clause
// A dynamic world repeats to the last bit, and distant bodies have no influence.
#include "core/digest.hpp"
#include "core/fields.hpp"
#include "tests/world/bullet/worlds.hpp"

namespace waitpoint::world {
namespace {

class DynamicRepetition : public DynamicWorldTest {
 protected:
  void crowd(int robots, double x_m) {
    for (int i = 0; i < robots; ++i) {
      BodyDescription body = robot(numbered("r", description_.bodies.size()), {x_m, 1.5 * i, 0.4});
      body.sensors<Sonars>().emplace_back();
      body.sensors<Lasers>().emplace_back();
      description_.bodies.push_back(body);
      description_.obstacles.push_back(
          loose_box(numbered("box", description_.obstacles.size()), {x_m + 1, 1.5 * i + 0.3, 0.1 * i}, 4 + i));
    }
    description_.obstacles.push_back(wall({x_m + 4, 4, 0}, 0.2, 12));
  }

  // The digest of the first robots and loose shapes, driven for a while.
  Digest driven(VehicleWorld& world, std::size_t count) {
    Digest digest;
    LaserScan scan;
    for (int k = 0; k < 400; ++k) {
      Draws draw(7 + static_cast<std::uint64_t>(k) / 50);
      for (std::size_t i = 0; i < world.description().bodies.size(); ++i)
        world.command(BodyId(i), {draw(-0.3, 0.9), draw(-1, 1)});
      if (k == 100) world.push("box1", {120, 40}, std::chrono::milliseconds(300));
      world.step();
      for (std::size_t i = 0; i < count; ++i) {
        add_value(digest, world.body(BodyId(i)));
        add_value(digest, world.odometer(BodyId(i)));
        add_value(digest, world.loose()[i]);
      }
      if (k % 10 == 0) world.scan(BodyId(0), 0, static_cast<std::uint64_t>(k), scan);
      for (const double range : scan.range_m) digest.add(range);
    }
    return digest;
  }
};

TEST_F(DynamicRepetition, TheSameBitsInANewWorldAndAfterAReset) {
  crowd(5, 0);
  start();
  const Digest first = driven(*world_, 5);
  world_->reset(1);
  EXPECT_EQ(driven(*world_, 5), first);
  start();
  EXPECT_EQ(driven(*world_, 5), first);
  EXPECT_NE(driven(*make_bullet_world(description_, 2), 5), first) << "noise is of the seed";
}

TEST_F(DynamicRepetition, CrowdsThatAreFarApartDoNotNoticeEachOther) {
  crowd(3, 0);
  start();
  const Digest alone = driven(*world_, 3);
  crowd(3, 500);
  start();
  EXPECT_EQ(driven(*world_, 3), alone);
}

}  // namespace
}  // namespace waitpoint::world
