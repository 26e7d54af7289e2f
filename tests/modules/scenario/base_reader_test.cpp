// SPDX-License-Identifier: BSD-3-Clause
// The base of a robot in a scenario.
#include <gtest/gtest.h>

#include "modules/scenario/scenario_reader.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;
using Kind = world::BaseDescription::Kind;

class BaseReader : public ::testing::Test {
 protected:
  /// The base of the valid scenario, its first two keys replaced.
  world::BaseDescription base(const std::string& text) const {
    return read(changed("kind: differential\n      v_max_m_s: 0.7", text)).robots.at(0).body.base;
  }
  Scenario read(std::string_view text, const std::vector<std::string>& assignments = {}) const {
    return read_scenario(folder_.write("s.yaml", text), assignments);
  }
  TemporaryFolder folder_;
};

TEST_F(BaseReader, EachKindHasItsOwnKeys) {
  EXPECT_EQ(base("kind: synchro").kind, Kind::synchro);
  EXPECT_EQ(base("kind: omni").kind, Kind::omni);
  const world::BaseDescription car =
      base("kind: ackermann\n      wheelbase_m: 0.7\n      steering_max_deg: 30\n      steering_rate_deg_s: 45");
  EXPECT_EQ(car.kind, Kind::ackermann);
  EXPECT_EQ(car.wheelbase_m, 0.7);
  EXPECT_NEAR(car.steering_max_rad, exact::pi / 6, 1e-15);
  EXPECT_NEAR(car.steering_rate_rad_s, exact::pi / 4, 1e-15);
  const world::BaseDescription tank = base("kind: skid_steer\n      effective_axle_ratio: 1.8");
  EXPECT_EQ(tank.kind, Kind::skid_steer);
  EXPECT_EQ(tank.effective_axle_ratio, 1.8);
  const world::BaseDescription drone =
      base("kind: aerial\n      climb_max_m_s: 0.4\n      climb_acceleration_m_s2: 0.9");
  EXPECT_EQ(drone.kind, Kind::aerial);
  EXPECT_EQ(drone.climb_max_m_s, 0.4);
  EXPECT_EQ(drone.climb_acceleration_m_s2, 0.9);
}

TEST_F(BaseReader, HasAWatchdogOnRequest) {
  EXPECT_EQ(base("kind: omni").watchdog, Duration());
  EXPECT_EQ(base("kind: omni\n      watchdog_ms: 300").watchdog, Duration(300ms));
}

TEST_F(BaseReader, AerialBasesHaveAStartHeight) {
  const std::string start = "robots.one.start_height_m=1.5";
  const Scenario flies = read(valid_scenario, {"robots.one.base.kind=aerial", start});
  EXPECT_EQ(flies.robots[0].body.start_height_m, 1.5);
  EXPECT_EQ(message_of<BadInput>([&] { read(valid_scenario, {start}); }),
            "--set " + start + ": expected no start_height_m: robot 'one' does not fly");
}

TEST_F(BaseReader, ReadsOdometryErrors) {
  const world::OdometryErrors errors =
      read(changed("{travel_scale: 1.01}",
                   "{wheel_diameter_ratio: 1.002, wheel_base_ratio: 0.99, wheel_noise_m_per_sqrt_m: 0.003, "
                   "wheel_ticks_per_m: 2000, slips_per_m: 0.5, slip_m: 0.02, slip_turn_rad: 0.03}"))
          .robots.at(0)
          .body.base.odometry;
  EXPECT_EQ(errors.wheel_diameter_ratio, 1.002);
  EXPECT_EQ(errors.wheel_base_ratio, 0.99);
  EXPECT_EQ(errors.wheel_noise_m_per_sqrt_m, 0.003);
  EXPECT_EQ(errors.wheel_ticks_per_m, 2000);
  EXPECT_EQ(errors.slips_per_m, 0.5);
  EXPECT_EQ(errors.slip_m, 0.02);
  EXPECT_EQ(errors.slip_turn_rad, 0.03);
}

struct BadBase {
  std::string name, text;
  int line;
  std::string expected;
};

class BadBases : public ::testing::TestWithParam<BadBase> {};

TEST_P(BadBases, AreReportedInOneLineWithFileAndLine) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "s.yaml",
      changed("kind: differential\n      v_max_m_s: 0.7\n      odometry: {travel_scale: 1.01}", GetParam().text));
  EXPECT_EQ(message_of<BadInput>([&] { read_scenario(file); }),
            file.string() + ":" + std::to_string(GetParam().line) + ": " + GetParam().expected);
}

const BadBase bad_bases[] = {
    {"a_wheelbase_of_another", "wheelbase_m: 0.7", 15, "expected no wheelbase_m: it is for a base of kind ackermann"},
    {"a_climb_on_the_floor", "kind: omni\n      climb_max_m_s: 0.7", 16,
     "expected no climb_max_m_s: it is for a base of kind aerial"},
    {"a_slip_of_another", "kind: differential\n      effective_axle_ratio: 2", 16,
     "expected no effective_axle_ratio: it is for a base of kind skid_steer"},
    {"a_slip_that_shortens", "kind: skid_steer\n      effective_axle_ratio: 0.9", 16,
     "expected effective_axle_ratio to be a number from 1 to 1000, found '0.9'"},
    {"steering_across", "kind: ackermann\n      steering_max_deg: 90", 16,
     "expected steering_max_deg to be degrees above 0, at most 89, found '90'"},
    {"a_wheelbase_of_nothing", "kind: ackermann\n      wheelbase_m: 0", 16,
     "expected wheelbase_m to be a length from 0.0001 to 100000 m, found '0'"},
    {"wheels_of_a_synchro_base", "kind: synchro\n      odometry: {wheel_base_ratio: 1.01}", 16,
     "expected no wheel_base_ratio: it is for a base of kind differential or skid_steer"},
    {"slips_without_end", "odometry: {slips_per_m: 1001}", 15,
     "expected slips_per_m to be a number from 0 to 1000, found '1001'"},
    {"a_watchdog_of_no_time", "watchdog_ms: 0", 15, "expected watchdog_ms to be a positive number, found '0'"},
};

INSTANTIATE_TEST_SUITE_P(Scenario, BadBases, ::testing::ValuesIn(bad_bases),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace waitpoint::scenario
