// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/intervention.hpp"

#include <gtest/gtest.h>

#include "core/exact_math.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::run {
namespace {

const scenario::Location here{"run.journal", 7};

Intervention parse(std::string_view text) { return parse_intervention(text, here); }
std::string complaint(std::string_view text) {
  return scenario::message_of<BadInput>([&] { parse(text); });
}

TEST(Intervention, ARequestHasItsArgumentsAsTheyAreWritten) {
  const Intervention intervention = parse("  request rackham ndd GoTo via.0.x=3 \"via.0.y= 4\"\n");
  EXPECT_EQ(intervention.text, "request rackham ndd GoTo via.0.x=3 \"via.0.y= 4\"");
  const auto& request = std::get<ModuleRequest>(intervention.what);
  EXPECT_EQ(request.robot, "rackham");
  EXPECT_EQ(request.module, "ndd");
  EXPECT_EQ(request.request, "GoTo");
  ASSERT_EQ(request.arguments.size(), 2u);
  EXPECT_EQ(request.arguments[1].key, "via.0.y");
  EXPECT_EQ(request.arguments[1].text, " 4");
  EXPECT_EQ(request.arguments[1].line, 7);
}

TEST(Intervention, PlacesAreThoseOfAScenario) {
  const Intervention robot = parse("move \"robot one\" 1.5 -2 90");
  EXPECT_EQ(std::get<RobotMove>(robot.what).robot, "robot one");
  EXPECT_EQ(std::get<RobotMove>(robot.what).pose, (Pose{1.5, -2, exact::pi / 2}));
  EXPECT_EQ(std::get<ObstacleMove>(parse("move-obstacle crate 1 2").what).pose, (Pose{1, 2, 0}));
  const auto put = std::get<ObstaclePut>(parse("obstacle {name: bin, centre_m: [1, 2], radius_m: 0.2}").what);
  EXPECT_EQ(put.obstacle.name, "bin");
  EXPECT_EQ(put.obstacle.shape.radius_m, 0.2);
  EXPECT_EQ(std::get<ObstacleRemoval>(parse("remove-obstacle crate").what).name, "crate");
}

TEST(Intervention, APushIsAForceForATime) {
  const auto push = std::get<Push>(parse("push \"red box\" -3 4.5 0.25").what);
  EXPECT_EQ(push.name, "red box");
  EXPECT_EQ(push.force_n, (Point{-3, 4.5}));
  EXPECT_EQ(push.time, Duration(std::chrono::milliseconds(250)));
  EXPECT_EQ(complaint("push box 1"), "run.journal:7: expected a force, FX_N FY_N, within 1000000 N, found ''");
  EXPECT_EQ(complaint("push box 1 2 -1"), "run.journal:7: expected a time in seconds, at most 86400, found '-1'");
  EXPECT_EQ(complaint("push box 1e7 2 1"), "run.journal:7: expected a force, FX_N FY_N, within 1000000 N, found '1e7'");
  EXPECT_EQ(complaint("push box 1 2 1 1"), "run.journal:7: expected the end of the line, found '1'");
}

TEST(Intervention, ASeedIsAWholeNumberOf64Bits) {
  EXPECT_EQ(std::get<SeedChange>(parse("seed 18446744073709551615").what).seed, 18446744073709551615u);
  EXPECT_EQ(complaint("seed"), "run.journal:7: expected a seed");
  EXPECT_EQ(complaint("seed -1"), "run.journal:7: expected a seed from 0 to 2^64 - 1, found '-1'");
  EXPECT_EQ(complaint("seed 1 2"), "run.journal:7: expected the end of the line, found '2'");
}

TEST(Intervention, MalformedIsReportedInOneLineAtItsPlace) {
  EXPECT_EQ(complaint("mve rackham 1 2"), "run.journal:7: unknown intervention 'mve', did you mean 'move'?");
  EXPECT_EQ(complaint("move rackham 1"), "run.journal:7: expected a place, X Y [HEADING_DEG], found ''");
  EXPECT_EQ(complaint("move rackham 1,5 2"), "run.journal:7: expected a place, X Y [HEADING_DEG], found '1,5'");
  EXPECT_EQ(complaint("dance"),
            "run.journal:7: unknown intervention 'dance', expected request, move, obstacle, move-obstacle, "
            "remove-obstacle, push, seed, tcl, external, report, command, pose or goal");
  EXPECT_EQ(complaint("move rackham 1 2 3 4"), "run.journal:7: expected the end of the line, found '4'");
  EXPECT_EQ(complaint("move \"rackham 1 2"), "run.journal:7: expected a closing quote");
  EXPECT_EQ(complaint("request rackham ndd GoTo 3"), "run.journal:7: expected FIELD=VALUE, found '3'");
  EXPECT_EQ(complaint("request rackham ndd GoTo a=3 a=3"), "run.journal:7: 'a' is given twice");
  EXPECT_EQ(complaint("obstacle {centre_m: [1, 2], radius_m: 1}"),
            "run.journal:7: expected {name: ..., ...}, a shape with a name");
  EXPECT_EQ(complaint("obstacle {name: a,\n radius_m: 1}"), "run.journal:7: expected one line");
  for (const char* text : {"move rackham 1 far", "move rackham nan 2", "move rackham 1e9 2", "obstacle {name: a}",
                           "obstacle {name: a, centre_m: [1, 2], radius_m: 1, colour: red}"})
    EXPECT_EQ(complaint(text).find("run.journal:7: "), 0u) << complaint(text);
}

}  // namespace
}  // namespace waitpoint::run
