// SPDX-License-Identifier: BSD-3-Clause
#include "modules/executive/mission.hpp"

#include <gtest/gtest.h>

#include "tests/modules/executive/drawn_map.hpp"

namespace waitpoint::executive {
namespace {

Time seconds(std::int64_t n) { return Time::from_ns(n * 1000000000); }

// Two rooms of 3 m x 3 m connected by two doors; `second_door` false: only by the upper one.
OccupancyGrid rooms(bool second_door) {
  std::vector<std::string> rows;
  for (int r = 59; r >= 0; --r) {
    std::string row(121, ' ');
    if (r == 0 || r == 59) row = std::string(121, '#');
    row[0] = row[60] = row[120] = '#';
    if ((r >= 38 && r < 56) || (second_door && r >= 4 && r < 22)) row[60] = ' ';
    rows.push_back(row);
  }
  return test::drawn_map(rows, 0.05);
}

const std::vector<Point> in_the_upper_door = {{3.02, 2.2}, {3.02, 2.35}, {3.02, 2.5}};

struct MissionTest : testing::Test {
  MissionTest() : planner(rooms(true), {}), narrow_planner(rooms(false), {}), random(1, "robot", "mission") {}
  RoutePlanner planner, narrow_planner;
  RandomStream random;
  MissionParameters parameters;
};

TEST_F(MissionTest, VisitsTheGoalsInOrder) {
  Mission mission(planner, parameters, {{1, 1}, {5, 2}}, random);
  EXPECT_EQ(mission.start(seconds(0), {2, 2}).via_points.back(), (Point{1, 1}));
  EXPECT_EQ(mission.arrived(seconds(5), {1, 1}).via_points.back(), (Point{5, 2}));
  EXPECT_EQ(mission.arrived(seconds(9), {5, 2}).kind, MissionOrder::Kind::finished);
  EXPECT_EQ(mission.goals()[0].state, GoalState::reached);
  EXPECT_EQ(mission.goals()[1].date, seconds(9));
}

TEST_F(MissionTest, GoalWithoutARouteIsLeftWithItsReason) {
  Mission mission(planner, parameters, {{0.1, 1}, {-5, 0}, {5, 2}}, random);
  EXPECT_EQ(mission.start(seconds(0), {2, 2}).via_points.back(), (Point{5, 2}));
  EXPECT_EQ(mission.goals()[0].state, GoalState::no_route);
  EXPECT_EQ(mission.goals()[0].outcome, PlanOutcome::goal_too_close);
  EXPECT_EQ(mission.goals()[1].outcome, PlanOutcome::goal_outside);
  EXPECT_EQ(mission.current(), 2u);
}

TEST_F(MissionTest, BlockedDoorIsPlannedRound) {
  Mission mission(planner, parameters, {{5, 2.3}}, random);
  mission.start(seconds(0), {1, 2.3});
  const MissionOrder& order = mission.blocked(seconds(9), {2, 2.3}, in_the_upper_door);
  ASSERT_EQ(order.kind, MissionOrder::Kind::drive);
  bool by_the_lower_door = false;
  for (const Point p : order.via_points) by_the_lower_door |= p.y < 1.2;
  EXPECT_TRUE(by_the_lower_door);
}

TEST_F(MissionTest, WithoutAnotherWayItWaitsAndTriesTheSameAgain) {
  Mission mission(narrow_planner, parameters, {{5, 2.3}}, random);
  mission.start(seconds(0), {1, 2.3});
  const MissionOrder& order = mission.blocked(seconds(9), {2, 2.3}, in_the_upper_door);
  ASSERT_EQ(order.kind, MissionOrder::Kind::wait);
  EXPECT_GE(order.until, seconds(11));
  EXPECT_LE(order.until, seconds(17));
  EXPECT_EQ(mission.waited(order.until, {2, 2.3}).kind, MissionOrder::Kind::drive);
}

TEST_F(MissionTest, RobotsWaitForDifferentTimes) {
  Mission a(narrow_planner, parameters, {{5, 2.3}}, random);
  Mission b(narrow_planner, parameters, {{5, 2.3}}, RandomStream(1, "other", "mission"));
  a.start(seconds(0), {1, 2.3}), b.start(seconds(0), {1, 2.3});
  const Time until = a.blocked(seconds(9), {2, 2.3}, in_the_upper_door).until;
  EXPECT_NE(until, b.blocked(seconds(9), {2, 2.3}, in_the_upper_door).until);
}

TEST_F(MissionTest, GivesUpAfterTheTriesAllowed) {
  parameters.tries_max = 4;
  Mission mission(narrow_planner, parameters, {{5, 2.3}, {1, 1}}, random);
  mission.start(seconds(0), {1, 2.3});
  std::int64_t blocked = 0;
  while (mission.current() == 0 && blocked < 20) {
    ++blocked;
    const MissionOrder& order = mission.blocked(seconds(10 * blocked), {2, 2.3}, in_the_upper_door);
    if (order.kind == MissionOrder::Kind::wait) mission.waited(order.until, {2, 2.3});
  }
  EXPECT_EQ(mission.goals()[0].state, GoalState::given_up);
  EXPECT_LE(mission.goals()[0].tries, 5u);
  EXPECT_EQ(mission.current(), 1u);
}

TEST_F(MissionTest, InMotionAnotherRouteIsTakenOnlyIfItIsBetterByAPart) {
  parameters.better_by = 0.05;
  Mission mission(planner, parameters, {{5, 2.3}}, random);
  mission.start(seconds(0), {1, 2.3});
  EXPECT_EQ(mission.replanned({1, 2.3}), nullptr);
  planner.space().mark(in_the_upper_door);
  const MissionOrder* const order = mission.replanned({2, 2.3});
  ASSERT_NE(order, nullptr);
  EXPECT_EQ(order->via_points.back(), (Point{5, 2.3}));
  EXPECT_EQ(mission.replanned({2, 2.3}), nullptr);  // it is the present one now
  EXPECT_EQ(mission.goals()[0].tries, 1u);
}

TEST_F(MissionTest, InMotionADoorThatSeemsOpenAndClosedByTurnsIsLeftAtLast) {
  Mission mission(planner, parameters, {{5, 2.3}}, random);
  mission.start(seconds(0), {1, 2.3});
  int changes = 0;
  for (int turn = 0; turn < 20; ++turn) {
    planner.space().mark(in_the_upper_door);
    changes += mission.replanned({2, 2.3}) != nullptr ? 1 : 0;
    planner.space().forget();
    changes += mission.replanned({2, 2.3}) != nullptr ? 1 : 0;
  }
  EXPECT_GE(changes, 2);
  EXPECT_LE(changes, 11);
}

// An obstacle on the way to one goal is most likely still there on the way to the next.
TEST_F(MissionTest, MarksOutliveTheGoal) {
  Mission mission(planner, parameters, {{5, 2.3}, {1, 2.3}}, random);
  mission.start(seconds(0), {1, 2.3});
  mission.blocked(seconds(9), {2, 2.3}, in_the_upper_door);
  const MissionOrder& order = mission.arrived(seconds(30), {5, 2.3});
  ASSERT_EQ(order.kind, MissionOrder::Kind::drive);
  bool by_the_lower_door = false;
  for (const Point via : order.via_points) by_the_lower_door |= via.y < 1.2;
  EXPECT_TRUE(by_the_lower_door);
}

TEST_F(MissionTest, MarksThatLeaveNoWayAreForgotten) {
  Mission mission(planner, parameters, {{5, 2.3}}, random);
  planner.space().mark(in_the_upper_door);
  planner.space().mark(std::vector<Point>{{3.02, 0.4}, {3.02, 0.65}, {3.02, 0.9}});
  EXPECT_EQ(mission.start(seconds(0), {1, 2.3}).kind, MissionOrder::Kind::drive);
  EXPECT_FALSE(planner.space().marked());
}

TEST_F(MissionTest, VisitsItsGoalsAsOftenAsThereAreRounds) {
  parameters.rounds = 2;
  Mission mission(planner, parameters, {{1, 1}, {5, 2}}, random);
  EXPECT_EQ(mission.start(seconds(0), {2, 2}).via_points.back(), (Point{1, 1}));
  EXPECT_EQ(mission.arrived(seconds(1), {1, 1}).via_points.back(), (Point{5, 2}));
  EXPECT_EQ(mission.arrived(seconds(2), {5, 2}).via_points.back(), (Point{1, 1}));
  EXPECT_EQ(mission.goals()[0].visits, 2u);
  EXPECT_EQ(mission.goals()[0].times_reached, 1u);
  EXPECT_EQ(mission.arrived(seconds(3), {1, 1}).via_points.back(), (Point{5, 2}));
  EXPECT_EQ(mission.arrived(seconds(4), {5, 2}).kind, MissionOrder::Kind::finished);
  EXPECT_EQ(mission.goals()[1].times_reached, 2u);
  EXPECT_EQ(mission.goals()[1].date, seconds(4));
}

TEST_F(MissionTest, RoundsWithoutEndRememberTheVisitThatMissed) {
  parameters.rounds = 0;
  parameters.tries_max = 1;
  Mission mission(planner, parameters, {{1, 1}, {5, 2}}, random);
  mission.start(seconds(0), {2, 2});
  for (std::int64_t round = 0; round < 1000; ++round) {
    ASSERT_EQ(mission.arrived(seconds(2 * round), {1, 1}).via_points.back(), (Point{5, 2}));
    const MissionOrder& order = round == 500 ? mission.blocked(seconds(2 * round + 1), {2, 2}, {})
                                             : mission.arrived(seconds(2 * round + 1), {5, 2});
    ASSERT_EQ(order.via_points.back(), (Point{1, 1}));
  }
  EXPECT_EQ(mission.goals()[0].visits, 1000u);
  EXPECT_EQ(mission.goals()[0].times_reached, 1000u);
  EXPECT_EQ(mission.goals()[1].visits, 1000u);
  EXPECT_EQ(mission.goals()[1].times_reached, 999u);
  EXPECT_EQ(mission.goals()[1].state, GoalState::given_up);
  EXPECT_EQ(mission.goals()[1].date, seconds(1001));
}

TEST_F(MissionTest, EveryRoundHasItsTries) {
  parameters.rounds = 0;
  parameters.tries_max = 2;
  Mission mission(planner, parameters, {{5, 2.3}}, random);
  mission.start(seconds(0), {1, 2.3});
  for (int round = 0; round < 4; ++round) {
    ASSERT_EQ(mission.blocked(seconds(9), {2, 2.3}, in_the_upper_door).kind, MissionOrder::Kind::drive);
    mission.arrived(seconds(30), {5, 2.3});
  }
  EXPECT_EQ(mission.goals()[0].times_reached, 4u);
}

TEST_F(MissionTest, RoundsOfGoalsWithoutARouteTakeTime) {
  parameters.rounds = 0;
  Mission mission(planner, parameters, {{0.1, 1}, {-5, 0}}, random);
  const MissionOrder& order = mission.start(seconds(0), {2, 2});
  ASSERT_EQ(order.kind, MissionOrder::Kind::wait);
  EXPECT_GE(order.until, seconds(2));
  EXPECT_EQ(mission.waited(order.until, {2, 2}).kind, MissionOrder::Kind::wait);
  EXPECT_EQ(mission.goals()[0].visits, 2u);
  EXPECT_EQ(mission.goals()[0].times_reached, 0u);
}

}  // namespace
}  // namespace waitpoint::executive
