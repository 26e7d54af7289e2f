// SPDX-License-Identifier: BSD-3-Clause
#include "world/motion/contact_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/world/scenes.hpp"

namespace waitpoint::world {
namespace {

struct Crowd {
  std::vector<Shape> shapes;
  std::vector<Arc> arcs;
  std::vector<Outline> obstacles = {};
  std::vector<Shape> standing = {};  // the shapes of these outlines

  Mover mover(std::size_t i) const { return Mover(shapes[i], outline_of(shapes[i], arcs[i].start), arcs[i]); }
};

// Runs the crowd with its bodies numbered in that order; the results are in the crowd's own order.
std::vector<std::optional<double>> stops(const Crowd& crowd, const std::vector<std::size_t>& order) {
  ContactLoop loop;
  for (const std::size_t i : order) loop.add_body(crowd.mover(i));
  const auto count = static_cast<std::uint32_t>(order.size());
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const Outline& obstacle : crowd.obstacles) loop.add_obstacle(i, obstacle);
    for (std::uint32_t j = i + 1; j < count; ++j) loop.add_pair(i, j);
  }
  loop.run();
  std::vector<std::optional<double>> result(order.size());
  for (std::uint32_t i = 0; i < count; ++i) result[order[i]] = loop.stop(i);
  return result;
}

std::vector<std::size_t> in_order(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

Outline at(const Crowd& crowd, std::size_t i, const std::optional<double>& stop, double fraction) {
  return crowd.mover(i).at(stop ? std::min(*stop, fraction) : fraction);
}

// No two bodies, and no body and obstacle, come nearer than half the contact gap at any time.
void expect_apart(const Crowd& crowd, const std::vector<std::optional<double>>& stop, int samples) {
  for (int k = 0; k <= samples; ++k) {
    const double f = static_cast<double>(k) / samples;
    for (std::size_t i = 0; i < stop.size(); ++i) {
      const Outline body = at(crowd, i, stop[i], f);
      for (const Outline& obstacle : crowd.obstacles) {
        ASSERT_GT(separation(body, obstacle).distance_m, 0.49 * contact_gap_m) << i << " at " << f;
      }
      for (std::size_t j = i + 1; j < stop.size(); ++j) {
        ASSERT_GT(separation(body, at(crowd, j, stop[j], f)).distance_m, 0.49 * contact_gap_m)
            << i << " and " << j << " at " << f;
      }
    }
  }
}

Crowd random_crowd(Draws& draw, std::size_t bodies) {
  Crowd crowd;
  const double speed = draw(0.01, 6);
  while (crowd.shapes.size() < bodies) {
    Shape shape = random_shape(draw, 0.1, 0.9);
    const Arc arc = {{draw(-2, 2), draw(-2, 2), draw(-3, 3)}, speed * draw(-1, 1), speed * draw(-1, 1)};
    const Outline outline = outline_of(shape, arc.start);
    bool clear = true;
    for (std::size_t i = 0; i < crowd.shapes.size(); ++i) {
      clear = clear && separation(outline, crowd.mover(i).start()).distance_m > 2 * contact_gap_m;
    }
    if (!clear) continue;
    crowd.shapes.push_back(shape);
    crowd.arcs.push_back(arc);
  }
  for (int i = 0; i < 3; ++i) {
    const Outline obstacle = outline_of(crowd.standing.emplace_back(random_shape(draw, 2.5, 0.5)));
    bool clear = true;
    for (std::size_t k = 0; k < bodies; ++k) {
      clear = clear && separation(obstacle, crowd.mover(k).start()).distance_m > 2 * contact_gap_m;
    }
    if (clear) crowd.obstacles.push_back(obstacle);
  }
  return crowd;
}

TEST(ContactLoop, RandomCrowdsNeverOverlapAndEveryNumberingGivesTheSameStops) {
  Draws draw(1);
  int stopped = 0;
  for (int round = 0; round < 600; ++round) {
    const Crowd crowd = random_crowd(draw, 2 + round % 6);
    std::vector<std::size_t> order = in_order(crowd.shapes.size());
    const auto stop = stops(crowd, order);
    expect_apart(crowd, stop, 40);
    stopped += static_cast<int>(std::count_if(stop.begin(), stop.end(), [](const auto& s) { return s.has_value(); }));
    for (int k = 0; k < 5; ++k) {
      for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[draw.below(i + 1)]);
      ASSERT_EQ(stops(crowd, order), stop);
    }
  }
  EXPECT_GT(stopped, 500);
}

TEST(ContactLoop, HeadOnBothStopInTheMiddle) {
  const Shape disc = cylinder({0, 0}, 0.25);
  const Crowd crowd = {{disc, disc}, {{{0, 0, 0}, 5, 0}, {{4, 0, exact::pi}, 5, 0}}, {}};
  const auto stop = stops(crowd, in_order(2));
  ASSERT_TRUE(stop[0] && stop[1]);
  EXPECT_EQ(*stop[0], *stop[1]);
  EXPECT_NEAR(*stop[0] * 5, 1.75 - 0.5 * contact_gap_m, 1e-9);
}

TEST(ContactLoop, DrivenIntoFromBehindTheFrontOneGoesOn) {
  const Shape disc = cylinder({0, 0}, 0.25);
  const Crowd crowd = {{disc, disc}, {{{0, 0, 0}, 5, 0}, {{1, 0, 0}, 0.5, 0}}, {}};
  const auto stop = stops(crowd, in_order(2));
  ASSERT_TRUE(stop[0]);
  EXPECT_FALSE(stop[1]);
  EXPECT_NEAR(*stop[0] * 4.5, 0.5, 1e-5);
  expect_apart(crowd, stop, 100);
}

TEST(ContactLoop, StandingBodyIsHitButDoesNotStop) {
  const Shape disc = cylinder({0, 0}, 0.25);
  const Crowd crowd = {{disc, disc}, {{{0, 0, 0}, 5, 0}, {{1, 0.1, 2}, 0, 0}}, {}};
  const auto stop = stops(crowd, in_order(2));
  EXPECT_TRUE(stop[0]);
  EXPECT_FALSE(stop[1]);
}

TEST(ContactLoop, ThreeAtOnceMeetInTheMiddle) {
  const Shape disc = cylinder({0, 0}, 0.25);
  Crowd crowd;
  for (int k = 0; k < 3; ++k) {
    const double direction = 2 * exact::pi * k / 3;
    const auto [s, c] = exact::sincos(direction);
    crowd.shapes.push_back(disc);
    crowd.arcs.push_back({{-2 * c, -2 * s, direction}, 3, 0});
  }
  std::vector<std::size_t> order = in_order(3);
  const auto stop = stops(crowd, order);
  expect_apart(crowd, stop, 200);
  for (const auto& s : stop) {
    ASSERT_TRUE(s);
    EXPECT_NEAR(*s * 3, 2 - 0.25 / exact::sin(exact::pi / 3), 1e-5);
  }
  while (std::next_permutation(order.begin(), order.end())) EXPECT_EQ(stops(crowd, order), stop);
}

TEST(ContactLoop, CrossingTheFirstToTheCrossingGoesOn) {
  const Shape disc = cylinder({0, 0}, 0.25);
  // The second hits the side of the first, which is just ahead.
  const Crowd crowd = {{disc, disc}, {{{-1, 0, 0}, 3, 0}, {{0.3, -1.2, 0.5 * exact::pi}, 3, 0}}, {}};
  const auto stop = stops(crowd, in_order(2));
  expect_apart(crowd, stop, 200);
  EXPECT_TRUE(stop[1]);
}

TEST(ContactLoop, ASeriesStopsOneAfterTheOther) {
  const Shape disc = cylinder({0, 0}, 0.25);
  Crowd crowd;
  for (int k = 0; k < 5; ++k) {
    crowd.shapes.push_back(disc);
    crowd.arcs.push_back({{-1.0 * k, 0, 0}, 9, 0});
  }
  crowd.obstacles.push_back(outline_of(box({1, 0, 0}, 0.001, 4)));
  const auto stop = stops(crowd, in_order(5));
  expect_apart(crowd, stop, 200);
  for (std::size_t k = 0; k < 5; ++k) {
    ASSERT_TRUE(stop[k]);
    EXPECT_NEAR(*stop[k] * 9, 0.7495 + 0.5 * static_cast<double>(k), 1e-5);
  }
}

}  // namespace
}  // namespace waitpoint::world
