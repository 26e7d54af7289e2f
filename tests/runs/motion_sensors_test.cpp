// SPDX-License-Identifier: BSD-3-Clause
// Inertial sensors, a satellite receiver and a battery, from the scenario through the world and the bridge to the
// posters of `rflex`.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "modules/genom/client.hpp"
#include "modules/rflex/rflex.hpp"
#include "tests/runs/shipped.hpp"
#include "tools/output/summary.hpp"
#include "tools/papers_modules.hpp"

namespace waitpoint::runs {
namespace {

constexpr double speed_m_s = 0.4, turn_rad_s = 0.5;

// Calibrates the gyro on demand, then drives in a circle, in place of the module under whose name it is registered.
class Circler : public genom::Module {
 public:
  explicit Circler(genom::ModuleSetup& setup)
      : Module(setup, 91), client_(setup.names, "circler"), task_(add_task("main", {})) {
    task_.set_start([this] {
      if (calibrate_) client_.call("rflex", "CalibrateGyro", genom::Nothing());
      client_.send("rflex", "GotoSpeed", rflex::SpeedInput{speed_m_s, turn_rad_s});
    });
    setup.settings.read_one("calibrate", calibrate_);
  }

 private:
  genom::Client client_;
  genom::ExecutionTask& task_;
  bool calibrate_ = false;
};

/// The office, with free space for a circle, and the robot's usual bridge table with `rows` added.
scenario::Scenario circling(const std::string& rows, std::vector<std::string> more) {
  std::vector<std::string> assignments = {
      "world.shapes=[]", "robots.0.goals=[]", "robots.0.start=[20,13,0]",
      "robot_types.rackham.modules.ndd.type=circler",
      "robot_types.rackham.bridge=[{poster: rflex.command, device: base.command}, "
      "{poster: rflex.reading, device: base.reading}, {poster: sick.command, device: laser.command}, "
      "{poster: sick.reading, device: laser.reading}" +
          rows + "]"};
  assignments.insert(assignments.end(), more.begin(), more.end());
  return shipped("office.yaml", assignments);
}

class CirclingRun {
 public:
  CirclingRun(scenario::Scenario scenario, int seconds, std::uint64_t seed = 1)
      : scenario_(std::move(scenario)), experiment_(scenario_, types(), {seed, kernel::Order::fifo, ""}) {
    experiment_.run_before(Time() + Duration(std::chrono::seconds(seconds)));
  }

  const world::BodyState& truth() const { return experiment_.world().body(world::BodyId(0)); }
  bridge::RunResult result() const { return experiment_.result(); }
  template <class T>
  T shown(const std::string& poster) const {
    const auto value =
        dynamic_cast<const genom::Poster<T>&>(*experiment_.robots()[0]->names().find_poster(poster)).look();
    EXPECT_TRUE(value.has_value()) << poster;
    return value.value_or(T());
  }

 private:
  static std::vector<genom::ModuleType> types() {
    std::vector<genom::ModuleType> types = tools::papers_modules();
    types.push_back(genom::module_type<Circler>("circler"));
    return types;
  }

  scenario::Scenario scenario_;  // the experiment refers to it
  run::Experiment experiment_;
};

const std::string both_rows =
    ", {poster: rflex.imu_reading, device: imu.reading}, {poster: rflex.gps_reading, device: gps.reading}";

TEST(MotionSensors, AreDescriptionsAndLinesOfTheTable) {
  const CirclingRun run(circling(both_rows, {"robot_types.rackham.imu={period_ms: 20}",
                                             "robot_types.rackham.gps={antenna_m: [-0.1, 0], bias_x_m: 1.5}"}),
                        10);
  const world::Imu::Reading imu = run.shown<world::Imu::Reading>("rflex.imu");
  EXPECT_NEAR(imu.turn_rad_s, turn_rad_s, 1e-9);
  EXPECT_NEAR(imu.left_m_s2, speed_m_s * turn_rad_s, 1e-9);
  EXPECT_GT(imu.number, 490u);
  EXPECT_GT(imu.date, Time() + Duration(std::chrono::milliseconds(9900)));
  const world::Gps::Reading fix = run.shown<world::Gps::Reading>("rflex.gps");
  EXPECT_GE(fix.number, 8u);
  EXPECT_GE(fix.date, Time() + Duration(std::chrono::seconds(8)));
  const double since_s = (Time() + Duration(std::chrono::seconds(10)) - fix.date).seconds();
  EXPECT_NEAR(length(fix.position - Point{1.5, 0} - run.truth().pose.position()), 0.1, since_s * speed_m_s + 0.02);
}

// 80 s of the yard: odometry alone is metres off by then.
TEST(MotionSensors, PomIsRightByAReceiverWhereWheelsErrAndNoWallsAreKnown) {
  const auto yard = [](const std::vector<std::string>& more) {
    return run(shipped("yard.yaml", more), std::chrono::seconds(80)).robots[0];
  };
  const bridge::RobotResult by_wheels = yard({"robot_types.rackham.modules.pom.gps=false"});
  EXPECT_GT(by_wheels.position_error_max_m, 5);
  const bridge::RobotResult by_fixes = yard({});
  EXPECT_LT(by_fixes.position_error_max_m, 1.5);
  EXPECT_GT(by_fixes.odometry_error_max_m, 5);
  EXPECT_EQ(by_fixes.collisions, 0u);
}

double heading_error(const CirclingRun& run) {
  const double shown = run.shown<posters::Odometry>("rflex.odometry").position.pose.heading;
  return std::fabs(exact::wrap_angle(shown - run.truth().pose.heading));
}

// The wheels report 3 % more turn than the true one; the gyro has a bias of 1.1 degrees a second, which calibration
// finds.
TEST(MotionSensors, OdometryTurnsByACalibratedGyroWhereItsWheelsErr) {
  const std::string row = ", {poster: rflex.imu_reading, device: imu.reading}";
  const std::string wheels = "robot_types.rackham.base.odometry.turn_scale=1.03";
  const std::string gyro =
      "robot_types.rackham.imu={gyro_rad_s: {bias: 0.0175, noise_per_sqrt_hz: 0.0002, scale: 1.001}}";
  const std::string turns = "robot_types.rackham.modules.rflex.gyro_turns=true";
  const std::string calibrate = "robots.0.modules=[{name: ndd, calibrate: true}]";
  constexpr std::uint64_t seed = 2;  // with a gyro bias that is large enough to measure
  const CirclingRun by_wheels(circling(row, {wheels, gyro, calibrate}), 45, seed);
  const CirclingRun uncalibrated(circling(row, {wheels, gyro, turns}), 45, seed);
  const CirclingRun calibrated(circling(row, {wheels, gyro, turns, calibrate}), 45, seed);
  const double bias_rad_s = 0.0175 * RandomStream(seed, "rackham", "imu.gyro.bias").normal(0);
  EXPECT_NEAR(heading_error(by_wheels), 0.03 * 40 * turn_rad_s, 0.06);
  EXPECT_NEAR(heading_error(uncalibrated), bias_rad_s * 45, 0.05);
  EXPECT_LT(heading_error(calibrated), 0.04);
}

// 0.02 Ah at 10 A: 7.2 s.
TEST(Battery, EmptyStopsTheRobotAndItsPosters) {
  const scenario::Scenario scenario = circling(
      "", {"robot_types.rackham.battery={capacity_ah: 0.02, rated_h: 1, peukert: 1, idle_a: 10, drive_a_per_m_s: 0, "
           "turn_a_per_rad_s: 0}"});
  const CirclingRun half(scenario, 4), run(scenario, 15);
  const posters::Battery battery = half.shown<posters::Battery>("rflex.battery");
  EXPECT_NEAR(battery.charge, 1 - battery.date.seconds() / 7.2, 0.003);
  EXPECT_EQ(battery.current_a, 10);
  EXPECT_EQ(run.truth().velocity, world::Velocity());
  const Time off = Time() + Duration(std::chrono::milliseconds(7200));
  const Time last = run.shown<posters::Odometry>("rflex.odometry").position.date;
  EXPECT_LE(last, off);
  EXPECT_GT(last, off - Duration(std::chrono::milliseconds(50)));
  const bridge::RunResult result = run.result();
  ASSERT_TRUE(result.robots[0].battery.has_value());
  EXPECT_NEAR(result.robots[0].battery->empty_at->seconds(), 7.2, 0.02);
  EXPECT_NE(tools::summary_text(result).find(": battery empty at 7.2 s, off since then\n"), std::string::npos);
}

TEST(Battery, IsLowByItsChargeToo) {
  const std::string one = "robot_types.rackham.battery={capacity_ah: 0.02, rated_h: 1, peukert: 1, idle_a: 10}";
  const std::string low = "robot_types.rackham.modules.rflex.battery_low_charge=0.999";
  EXPECT_FALSE(CirclingRun(circling("", {one}), 1).shown<posters::Battery>("rflex.battery").low);
  EXPECT_TRUE(CirclingRun(circling("", {one, low}), 1).shown<posters::Battery>("rflex.battery").low);
}

TEST(MotionSensors, UnreadOnesChangeNothing) {
  const std::vector<std::string> quiet = {"robots.0.goals=[]"};
  std::vector<std::string> equipped = quiet;
  equipped.push_back("robot_types.rackham.imu={gyro_rad_s: {bias: 0.01, drift: 0.01}}");
  equipped.push_back("robot_types.rackham.gps={noise_m: 1, drift_m: 2}");
  const Duration second = std::chrono::seconds(1);
  EXPECT_EQ(run(shipped("office.yaml", quiet), second).digest, run(shipped("office.yaml", equipped), second).digest);
}

}  // namespace
}  // namespace waitpoint::runs
