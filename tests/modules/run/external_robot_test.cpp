// SPDX-License-Identifier: BSD-3-Clause
#include "modules/run/external_robot.hpp"

#include <gtest/gtest.h>

#include "core/exact_math.hpp"
#include "tests/modules/scenario/scenario_text.hpp"
#include "world/kinematic/kinematic_world.hpp"

namespace waitpoint::run {
namespace {

using namespace std::chrono_literals;

/// A robot of 0.2 m at the origin, a wall from x = 3 m on; steps of 10 ms.
class ExternalRobotTest : public testing::Test {
 protected:
  ExternalRobotTest() {
    world::WorldDescription description;
    world::BodyDescription body;
    body.name = "robot";
    body.shape.kind = world::Shape::Kind::cylinder;
    body.shape.radius_m = 0.2;
    description.bodies.push_back(body);
    world::Obstacle wall{"wall", {}};
    wall.shape.pose = {3.5, 0, 0};
    wall.shape.length_m = 1;
    wall.shape.width_m = 10;
    description.obstacles.push_back(wall);
    world_ = world::make_kinematic_world(description, 1);
  }

  void begin(const ExternalSettings& settings = {}) {
    robot_.emplace(*world_, world::BodyId(0), settings, now_,
                   [this](Time, const std::string& text) { told_ += text + "\n"; });
  }
  /// The world's next step, with a report of `x` at `date_s`, or none.
  void step(std::optional<PositionReport> report = std::nullopt) {
    now_ = now_ + 10ms;
    if (report) robot_->take(*report, now_);
    robot_->before_step(now_);
    world_->step();
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  const Pose& pose() const { return world_->body(world::BodyId(0)).pose; }
  std::string told() { return std::exchange(told_, {}); }

  std::unique_ptr<world::World> world_;
  std::optional<ExternalRobot> robot_;
  Time now_;
  std::string told_;
};

TEST_F(ExternalRobotTest, MovesOnAtTheReportedSpeedByTheLagAndUntilTheNextReport) {
  begin();
  steps(9);
  step(PositionReport{0.05, {0.1, 0, 0}, world::Velocity{1, 0}});
  EXPECT_NEAR(pose().x, 0.15, 1e-12) << "moved on from the date, 50 ms ago";
  steps(10);
  EXPECT_NEAR(pose().x, 0.25, 1e-12);
  EXPECT_EQ(told(), "");
}

TEST_F(ExternalRobotTest, StaysBetweenReportsIfSoSet) {
  begin({.between = "stay"});
  step(PositionReport{0, {0.1, 0, 0}, world::Velocity{1, 0}});
  steps(10);
  EXPECT_EQ(pose().x, 0.1);
}

TEST_F(ExternalRobotTest, AReportWithoutASpeedHasThatFromTheOneBefore) {
  begin();
  step(PositionReport{0.01, {0.1, 0, 0}, {}});
  steps(9);
  EXPECT_EQ(pose().x, 0.1);
  step(PositionReport{0.11, {0.2, 0, 0}, {}});
  steps(10);
  EXPECT_NEAR(pose().x, 0.3, 1e-9);
}

TEST_F(ExternalRobotTest, StopsAfterASilenceAndTellsIt) {
  begin({.silent_s = 50ms});
  steps(10);
  EXPECT_EQ(told(), "no report yet for 0.05 s: it stays at (0.00, 0.00)\n");
  step(PositionReport{0.11, {0.1, 0, 0}, world::Velocity{1, 0}});
  EXPECT_EQ(told(), "reports again, after 0.11 s\n");
  steps(50);
  EXPECT_NEAR(pose().x, 0.15, 1e-9);
  EXPECT_EQ(told(), "no report for 0.05 s: it stays at (0.15, 0.00)\n");
  EXPECT_EQ(robot_->figures().silences, 2u);
}

TEST_F(ExternalRobotTest, JumpsAreToldAndARefusedOneOnce) {
  begin();
  step(PositionReport{0.01, {-2, 1, 0}, {}});
  EXPECT_EQ(pose().position(), (Point{-2, 1}));
  EXPECT_EQ(told(), "jump of 2.24 m to (-2.00, 1.00)\n");
  step(PositionReport{0.02, {3.5, 0, 0}, {}});
  step(PositionReport{0.03, {3.5, 0, 0}, {}});
  EXPECT_EQ(told(), "stays at (-2.00, 1.00): 'wall' is in the way at the reported place (3.50, 0.00)\n");
  EXPECT_EQ(robot_->figures().jumps, 1u);
  EXPECT_EQ(robot_->figures().refused, 2u);
}

TEST_F(ExternalRobotTest, MeetsThingsAndTellsIt) {
  begin({.jump_m = 1});
  step(PositionReport{0.01, {2.5, 0, 0}, {}});
  told();
  step(PositionReport{0.02, {2.9, 0, 0}, {}});
  EXPECT_NEAR(pose().x, 2.8, 1e-5);
  step();
  EXPECT_EQ(told(), "stopped by a contact at (2.80, 0.00)\n");
  step(PositionReport{0.04, {2.6, 0, 0}, {}});
  step();
  EXPECT_EQ(told(), "free again at (2.60, 0.00)\n");
}

TEST_F(ExternalRobotTest, CountsTheLagAndTellsWhenItIsTooMuch) {
  begin({.late_s = 20ms});
  for (const double date_s : {0.01, 0.01, 0.0, 0.0, 0.05}) step(PositionReport{date_s, {}, {}});
  EXPECT_EQ(told(), "reports are late: by 0.03 s, more than 0.02 s\nreports are in time again: after 0 s\n");
  const bridge::ExternalFigures figures = robot_->figures();
  EXPECT_EQ(figures.reports, 5u);
  EXPECT_EQ(figures.late, 2u);
  EXPECT_EQ(figures.lag->least, Duration());
  EXPECT_EQ(figures.lag->median, Duration(10ms));
  EXPECT_EQ(figures.lag->most, Duration(40ms));
}

// --- reports as text ---

std::string complaint(std::string_view text) {
  return scenario::message_of<BadInput>([&] { (void)parse_report(text, "stamp_s", {"connection", 7}); });
}

TEST(PositionReport, IsReadWithTheBitsThatWereWritten) {
  const PositionReport report{1.0 / 3, {0.1, -1e-17, 3}, world::Velocity{0.7, 0, -0.1}};
  const PositionReport again = parse_report(to_text(report, "date_s"), "date_s", {"journal", 1});
  EXPECT_EQ(again.time_s, report.time_s);
  EXPECT_EQ(again.pose, report.pose);
  EXPECT_EQ(again.velocity, report.velocity);
  EXPECT_FALSE(parse_report("stamp_s=1 x_m=1 y_m=2 heading_rad=0", "stamp_s", {"c", 1}).velocity);
  EXPECT_NEAR(parse_report("stamp_s=1 x_m=1 y_m=2 heading_rad=7", "stamp_s", {"c", 1}).pose.heading, 7 - 2 * exact::pi,
              1e-12);
}

TEST(PositionReport, MalformedIsReportedInOneLineAtItsPlace) {
  EXPECT_EQ(complaint("stamp_s=1 x_m=nan y_m=0 heading_rad=0"),
            "connection:7: expected 'x_m' to be a number of at most 100000, found 'nan'");
  EXPECT_EQ(complaint("stamp_s=1 x_m=0 y_m=1e6 heading_rad=0"),
            "connection:7: expected 'y_m' to be a number of at most 100000, found '1e6'");
  EXPECT_EQ(complaint("stamp_s=1 x_m=0 x_m=1"), "connection:7: 'x_m' is given twice");
  EXPECT_EQ(complaint("stamp_s=1 xm=0"), "connection:7: unknown key 'xm', did you mean 'x_m'?");
  EXPECT_EQ(complaint("stamp_s=1 x_m=0 y_m=0"), "connection:7: expected heading_rad=NUMBER");
  EXPECT_EQ(complaint("here"), "connection:7: expected KEY=VALUE, found 'here'");
}

}  // namespace
}  // namespace waitpoint::run
