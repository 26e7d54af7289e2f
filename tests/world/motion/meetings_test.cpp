// SPDX-License-Identifier: BSD-3-Clause
// Steps of whole crowds, against testing all pairs of bodies and all obstacles.
#include "world/motion/meetings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

class Yard final : public MeetingPlace {
 public:
  Yard(std::vector<Shape> bodies, std::vector<Pose> poses, const std::vector<Shape>& obstacles)
      : shapes(std::move(bodies)), obstacles(obstacles), poses(std::move(poses)), heights_m(shapes.size()) {
    for (const Shape& obstacle : obstacles)
      standing.push_back(Mover(outline_of(obstacle), {obstacle.z_low_m, obstacle.z_high_m}));
    begin(std::vector<Velocity>(shapes.size()));
  }

  void begin(const std::vector<Velocity>& velocities) {
    arcs.clear();
    outlines.clear();
    motions.clear();
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      arcs.push_back(Arc::of(poses[i], velocities[i], 1));
      outlines.push_back(outline_of(shapes[i], poses[i]));
      motions.push_back({path_m(arcs[i], reach_m(shapes[i])), arcs[i].moves()});
    }
  }
  void go(std::size_t i, const std::optional<double>& stop) {
    poses[i] = arcs[i].at(stop.value_or(1));
    heights_m[i] += stop.value_or(1) * arcs[i].climb_m;
  }
  std::vector<std::optional<double>> all_against_all() const {
    ContactLoop loop;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) loop.add_body(mover(i));
    for (std::uint32_t i = 0; i < shapes.size(); ++i) {
      if (!arcs[i].moves()) continue;
      for (const Mover& obstacle : standing) loop.add_obstacle(i, obstacle.start(), obstacle.heights());
      for (std::uint32_t j = 0; j < shapes.size(); ++j)
        if (j > i || (j != i && !arcs[j].moves())) loop.add_pair(i, j);
    }
    loop.run();
    std::vector<std::optional<double>> stops;
    for (std::uint32_t i = 0; i < shapes.size(); ++i) stops.push_back(loop.stop(i));
    return stops;
  }

  const Outline& outline(std::uint32_t body) const override { return outlines[body]; }
  Mover mover(std::uint32_t body) const override {
    return Mover(shapes[body], outlines[body], arcs[body], heights_m[body]);
  }
  void near(std::uint32_t, const Bounds& bounds, std::vector<std::uint32_t>& found) const override {
    ++asked;
    found.clear();
    for (std::uint32_t i = 0; i < standing.size(); ++i)
      if (bounds_of(standing[i].start()).overlaps(bounds)) found.push_back(i);
  }
  Mover obstacle(std::uint32_t obstacle) const override { return standing[obstacle]; }
  double gap_m(std::uint32_t body, std::uint32_t obstacle) const override {
    return separation(outline(body), standing[obstacle].start()).distance_m;
  }

  std::vector<Shape> shapes, obstacles;
  std::vector<Pose> poses;
  std::vector<double> heights_m;
  std::vector<Mover> standing;
  std::vector<Arc> arcs;
  std::vector<Outline> outlines;
  std::vector<Meetings::Motion> motions;
  mutable long asked = 0;
};

Yard crowded_yard(Draws& draw, std::size_t bodies, double half_square_m) {
  std::vector<Shape> shapes, taken, obstacles;
  for (int i = 0; i < 8; ++i) taken.push_back(obstacles.emplace_back(random_shape(draw, half_square_m, 1.5)));
  std::vector<Pose> poses;
  while (shapes.size() < bodies) {
    Shape shape = random_shape(draw, 0.05, 0.8);
    const Pose at = {draw(-half_square_m, half_square_m), draw(-half_square_m, half_square_m), draw(-3, 3)};
    const Outline outline = outline_of(shape, at);
    const bool free = std::all_of(taken.begin(), taken.end(), [&](const Shape& other) {
      return separation(outline, outline_of(other)).distance_m > 2 * contact_gap_m;
    });
    if (!free) continue;
    shapes.push_back(shape);
    poses.push_back(at);
    shape.pose = compose(at, shape.pose);
    taken.push_back(shape);
  }
  return Yard(shapes, poses, obstacles);
}

// With varying speeds, some bodies at rest, and occasional interventions that move one.
TEST(Meetings, StopTheSameBodiesAsAllPairsBitForBit) {
  std::size_t stopped = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    Draws draw(seed);
    const double speed = draw(0.001, 0.3);
    const bool fly = seed % 3 == 0;
    Yard yard = crowded_yard(draw, 40, 4);
    Meetings meetings(yard, yard.shapes);
    std::vector<Velocity> velocities(yard.shapes.size());
    for (int step = 0; step < 150; ++step) {
      const double pace = step % 50 < 5 ? 4 * speed : speed;
      for (Velocity& velocity : velocities) {
        if (draw(0, 1) > 0.1) continue;
        velocity = {draw(-pace, pace), draw(-pace, pace)};
        if (fly) velocity.climb_m_s = draw(-0.1, 0.1);
        if (draw(0, 1) < 0.2) velocity = {};
      }
      yard.begin(velocities);
      const std::vector<std::optional<double>> expected = yard.all_against_all();
      meetings.step(yard.motions);
      for (std::uint32_t i = 0; i < yard.shapes.size(); ++i) {
        ASSERT_EQ(meetings.stop(i), expected[i]) << seed << ", " << step << ", " << i;
        yard.go(i, expected[i]);
        stopped += expected[i] ? 1 : 0;
      }
      if (step % 40 != 39) continue;
      yard.poses[0] = {50.0 + step, 50, 0};
      meetings.forget();
    }
  }
  EXPECT_GT(stopped, 2000u);
}

TEST(Meetings, NeighboursAreLookedForOnceInManySteps) {
  Draws draw(1);
  Yard yard = crowded_yard(draw, 40, 20);
  Meetings meetings(yard, yard.shapes);
  for (int step = 0; step < 400; ++step) {
    yard.begin(std::vector<Velocity>(40, Velocity{0.005, 0.01}));
    meetings.step(yard.motions);
    for (std::uint32_t i = 0; i < 40; ++i) yard.go(i, meetings.stop(i));
  }
  EXPECT_LT(yard.asked, 40 * 400 / 20);
}

}  // namespace
}  // namespace waitpoint::world
