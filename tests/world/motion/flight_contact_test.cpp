// SPDX-License-Identifier: BSD-3-Clause
// Contacts of climbing and sinking bodies, with obstacles and with each other.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/world/scenes.hpp"
#include "world/motion/contact_loop.hpp"

namespace waitpoint::world {
namespace {

Shape between(Shape shape, double low_m, double high_m) {
  shape.z_low_m = low_m;
  shape.z_high_m = high_m;
  return shape;
}

const Shape disc = between(cylinder({0, 0}, 0.25), 0, 0.2);

Mover flying(const Shape& shape, const Arc& arc, double height_m) {
  return Mover(shape, outline_of(shape, arc.start), arc, height_m);
}

Mover standing(const Shape& shape) { return Mover(outline_of(shape), {shape.z_low_m, shape.z_high_m}); }

double height_gap(const Mover& a, const Mover& b, double fraction) {
  return VerticalGap(a.heights(), a.climb_m(), b.heights(), b.climb_m()).at(fraction);
}

// Must stay above 0: solids touch if they overlap both seen from above and in height.
double flight_gap(const Mover& a, const Mover& b, double fraction) {
  return std::max(height_gap(a, b, fraction), separation(a.at(fraction), b.at(fraction)).distance_m);
}

TEST(FlightContact, SinkingStopsAMicrometreAboveTheTableAtAnySpeed) {
  const Mover table = standing(between(box({0.3, 0, 0.2}, 1, 1), 0.7, 0.7005));
  for (const double sink_m : {0.31, 1.0, 30.0, 1e4}) {
    const Mover body = flying(disc, {{0, 0, 0}, 0, 0.3, 0, -sink_m}, 1);
    const auto contact = first_contact(body, table, 0);
    ASSERT_TRUE(contact) << sink_m;
    EXPECT_TRUE(contact->first_closes);
    EXPECT_FALSE(contact->second_closes);
    EXPECT_NEAR(contact->fraction * sink_m, 0.2995 - contact_gap_m, 1e-9);
  }
  EXPECT_FALSE(first_contact(flying(disc, {{0, 0, 0}, 0, 0, 0, -0.2994}, 1), table, 0)) << "not far enough";
  EXPECT_FALSE(first_contact(flying(disc, {{-0.7, 0, 0}, 0, 0, 0, -5}, 1), table, 0)) << "beside it";
}

// It reaches the wall after 1.75 of 4 m, and after 1.75 / 4 of its climb, which starts at 0.5 m.
TEST(FlightContact, ClimbingBodyPassesOverAWall) {
  const Mover wall = standing(between(box({2.0005, 0, 0}, 0.001, 10), 0, 1));
  const auto contact_at = [&](double climb_m) {
    return first_contact(flying(disc, {{0, 0, 0}, 4, 0, 0, climb_m}, 0.5), wall, 0);
  };
  for (const double climb_m : {-0.1, 0.0, 1.0, 0.5 * 4 / 1.75 - 1e-4}) {
    const auto contact = contact_at(climb_m);
    ASSERT_TRUE(contact) << climb_m;
    EXPECT_NEAR(contact->fraction * 4, 1.75 - contact_gap_m, 1e-9);
  }
  EXPECT_FALSE(contact_at(0.5 * 4 / 1.75 + 1e-4));
  EXPECT_FALSE(contact_at(3));
}

TEST(FlightContact, SinkingBodyHitsTheTopOfAWall) {
  // It is over the wall, 2 m thick, from 1.75 m on, and touches its top after sinking 0.4 m.
  const Mover block = standing(between(box({3, 0, 0}, 2, 10), 0, 1));
  const auto contact = first_contact(flying(disc, {{0, 0, 0}, 4, 0, 0, -0.6}, 1.4), block, 0);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->fraction * 0.6, 0.4 - contact_gap_m, 1e-9);
}

TEST(FlightContact, OnATableItSlidesAndRisesButDoesNotSink) {
  const Mover table = standing(between(box({0, 0, 0}, 9, 9), 0, 0.7));
  const double height = 0.7 + contact_gap_m;
  EXPECT_FALSE(first_contact(flying(disc, {{0, 0, 0}, 1, 0.5, 1}, height), table, 0));
  EXPECT_FALSE(first_contact(flying(disc, {{0, 0, 0}, 1, 0.5, 1, 0.1}, height), table, 0));
  const auto contact = first_contact(flying(disc, {{0, 0, 0}, 1, 0.5, 1, -0.1}, height), table, 0);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->fraction, 0);
}

TEST(FlightContact, AlongAWallItClimbs) {
  const Mover wall = standing(between(box({0.75, 0, 0}, 1, 9), 0, 5));
  const double x = -contact_gap_m;
  EXPECT_FALSE(first_contact(flying(disc, {{x, 0, 0}, 0, 0.3, 0, 1}, 1), wall, 0));
  EXPECT_FALSE(first_contact(flying(disc, {{x, 0, 0}, -0.1, 0.3, 0, -0.5}, 1), wall, 0));
  EXPECT_TRUE(first_contact(flying(disc, {{x, 0, 0}, 0.1, 0, 0, 1}, 1), wall, 0));
}

TEST(FlightContact, BodyHitFromAboveMovesOn) {
  const Mover below = flying(disc, {{0, 0, 0}, 0.1, 0}, 0);
  const auto contact = first_contact(flying(disc, {{0, 0.1, 0}, 0, 0, 0, -1}, 0.5), below, 0);
  ASSERT_TRUE(contact);
  EXPECT_NEAR(contact->fraction, 0.3 - contact_gap_m, 1e-9);
  EXPECT_TRUE(contact->first_closes);
  EXPECT_FALSE(contact->second_closes);
}

Mover random_flight(Draws& draw, const Shape& shape, double scale) {
  const Arc arc = {{draw(-2, 2), draw(-2, 2), draw(-3, 3)},
                   scale * draw(-2, 2),
                   scale * draw(-2, 2),
                   draw.below(2) == 0 ? 0 : scale * draw(-2, 2),
                   draw.below(4) == 0 ? 0 : scale * draw(-2, 2)};
  return flying(shape, arc, draw(0, 2));
}

TEST(FlightContact, NeverLateOnRandomFlights) {
  Draws draw(5);
  int from_the_side = 0, from_above = 0;
  for (int i = 0; i < 24000; ++i) {
    const Shape a = between(random_shape(draw, 0.2, 1), 0, draw(0.1, 0.6));
    const Shape b = between(random_shape(draw, 0.2, 1), 0, draw(0.1, 0.6));
    const double scale = i % 2 == 0 ? 1 : 20;
    const Mover first = random_flight(draw, a, scale);
    const Mover second = random_flight(draw, b, scale);
    if (flight_gap(first, second, 0) < 2 * contact_gap_m) continue;
    const auto contact = first_contact(first, second, 0);
    const double end = contact ? contact->fraction : 1;
    for (int k = 0; k <= 60; ++k) ASSERT_GT(flight_gap(first, second, end * k / 60), 0.49 * contact_gap_m);
    if (!contact) continue;
    const double height = height_gap(first, second, end);
    ++(height > 0 ? from_above : from_the_side);
    ASSERT_LT(flight_gap(first, second, end), contact_gap_m + 2 * contact_tolerance_m);
    ASSERT_LT(flight_gap(first, second, std::min(1.0, end + 1e-6 / scale)), flight_gap(first, second, end))
        << "it would have touched";
  }
  EXPECT_GT(from_the_side, 400);
  EXPECT_GT(from_above, 250);
}

TEST(FlightContact, ASwarmNeverOverlapsAndEveryNumberingGivesTheSameStops) {
  Draws draw(7);
  int stopped = 0;
  for (int round = 0; round < 700; ++round) {
    std::vector<Shape> shapes;
    shapes.reserve(6);
    for (int i = 0; i < 6; ++i) shapes.push_back(between(random_shape(draw, 0.1, 0.9), 0, draw(0.1, 0.5)));
    std::vector<Mover> movers;
    for (const Shape& shape : shapes) {
      const Mover mover = random_flight(draw, shape, 0.7);
      const bool clear = std::all_of(movers.begin(), movers.end(), [&](const Mover& other) {
        return flight_gap(mover, other, 0) > 2 * contact_gap_m;
      });
      if (clear) movers.push_back(mover);
    }
    std::vector<std::size_t> order(movers.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::vector<std::optional<double>> expected;
    for (int k = 0; k < 4; ++k) {
      ContactLoop loop;
      for (const std::size_t i : order) loop.add_body(movers[i]);
      for (std::uint32_t i = 0; i < order.size(); ++i)
        for (std::uint32_t j = i + 1; j < order.size(); ++j) loop.add_pair(i, j);
      loop.run();
      std::vector<std::optional<double>> stop(order.size());
      for (std::uint32_t i = 0; i < order.size(); ++i) stop[order[i]] = loop.stop(i);
      if (k == 0) expected = stop;
      ASSERT_EQ(stop, expected);
      for (std::size_t i = order.size() - 1; i > 0; --i) std::swap(order[i], order[draw.below(i + 1)]);
    }
    // Once stopped, it rests for the remainder of the step.
    const auto at = [&](std::size_t i, double f) { return movers[i].stopped_at(std::min(f, expected[i].value_or(1))); };
    for (int k = 0; k <= 40; ++k) {
      for (std::size_t i = 0; i < movers.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
          ASSERT_GT(flight_gap(at(i, k / 40.0), at(j, k / 40.0), 0), 0.49 * contact_gap_m);
    }
    for (const auto& s : expected) stopped += s ? 1 : 0;
  }
  EXPECT_GT(stopped, 250);
}

// --- in a world ------------------------------------------------------------------------------------------------------

BodyDescription drone(const std::string& name, const Pose& start, double height_m) {
  BodyDescription body = nimble_body(name, disc, start);
  body.base.kind = BaseDescription::Kind::aerial;
  body.base.climb_max_m_s = 1e5;
  body.base.climb_acceleration_m_s2 = 1e9;
  body.start_height_m = height_m;
  return body;
}

TEST(Flight, LandsOnARobotThatDrivesOnBelowIt) {
  WorldDescription description;
  description.bodies.push_back(drone("drone", {0, 0, 0}, 3));
  description.bodies.push_back(nimble_body("robot", between(box({0, 0, 0}, 2, 2), 0, 1), {0, 0, 0}));
  const auto world = make_kinematic_world(description, 1);
  world->command(BodyId(0), {0, 0, 0, -50});
  for (int i = 0; i < 20; ++i) world->step();
  EXPECT_NEAR(world->body(BodyId(0)).height_m, 1 + 1e-6, 1e-8);
  EXPECT_EQ(world->body(BodyId(0)).collisions, 1u);
  EXPECT_EQ(world->body(BodyId(1)).collisions, 0u);
  world->command(BodyId(1), {100, 0});
  world->step();
  EXPECT_NEAR(world->body(BodyId(1)).pose.x, 1, 1e-12) << "it drives on";
  for (int i = 0; i < 5; ++i) world->step();
  EXPECT_EQ(world->body(BodyId(0)).height_m, 0) << "and from under it: down to the floor";
}

TEST(Flight, TwoMeetInTheAirAndOthersPassBelow) {
  WorldDescription description;
  description.bodies.push_back(drone("a", {-2, 0, 0}, 2));
  description.bodies.push_back(drone("b", {2, 0, exact::pi}, 2.1));
  description.bodies.push_back(nimble_body("robot", between(cylinder({0, 0}, 0.25), 0, 1.2), {0, -2, exact::pi / 2}));
  const auto world = make_kinematic_world(description, 1);
  world->command(BodyId(0), {7, 0});
  world->command(BodyId(1), {7, 0});
  world->command(BodyId(2), {7, 0});
  for (int i = 0; i < 60; ++i) world->step();
  EXPECT_NEAR(world->body(BodyId(0)).pose.x, -0.25 - 0.5e-6, 1e-8);
  EXPECT_NEAR(world->body(BodyId(1)).pose.x, 0.25 + 0.5e-6, 1e-8);
  EXPECT_NEAR(world->body(BodyId(2)).pose.y, 2.2, 1e-9);
  EXPECT_EQ(world->body(BodyId(2)).collisions, 0u);
}

TEST(Flight, APersonPutsItDownAtItsOwnHeight) {
  WorldDescription description;
  description.bodies.push_back(drone("drone", {0, 0, 0}, 2));
  description.obstacles.push_back({"desk", between(box({3, 0, 0}, 1, 1), 0, 0.75), true});
  const auto world = make_kinematic_world(description, 1);
  EXPECT_EQ(world->move_body(BodyId(0), {3, 0, 0}), std::nullopt) << "above the desk";
  EXPECT_EQ(world->put_obstacle({"shelf", between(box({3, 0, 0}, 1, 1), 0, 2.1), true}), "drone");
  EXPECT_EQ(world->body(BodyId(0)).height_m, 2);
}

}  // namespace
}  // namespace waitpoint::world
