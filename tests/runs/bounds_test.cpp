// SPDX-License-Identifier: BSD-3-Clause
// The bounds of a scenario's numbers: with a number at its bound the scenario runs, beyond it is refused in one line
// that names the key.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/project.hpp"
#include "tools/main.hpp"

namespace waitpoint {
namespace {

struct Bound {
  std::string scenario;  ///< of the corpus of the fuzzer that runs scenarios
  std::string key;
  std::vector<std::string> at, beyond;
};

/// The status of a short run with the key set, and its messages.
std::pair<int, std::string> run_with(const Bound& bound, const std::string& value) {
  const std::string file = (test::project_root() / "tests/fuzz/corpus/scenario_run" / bound.scenario).string();
  const std::string assignment = bound.key + "=" + value;
  const std::vector<const char*> arguments = {"waitpoint", "run",   file.c_str(),      "--until",
                                              "0.2",       "--set", assignment.c_str()};
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int status = waitpoint::main(static_cast<int>(arguments.size()), arguments.data());
  testing::internal::GetCapturedStdout();
  return {status, testing::internal::GetCapturedStderr()};
}

class Bounds : public testing::TestWithParam<Bound> {};

TEST_P(Bounds, AreRunAndNotExceeded) {
  const Bound& bound = GetParam();
  for (const std::string& value : bound.at) {
    const auto [status, text] = run_with(bound, value);
    EXPECT_LE(status, 1) << value << ": " << text;  // 1: an expectation of the scenario is not met
  }
  const std::string last_key = bound.key.substr(bound.key.rfind('.', bound.key.find_last_not_of("0123456789.")) + 1);
  for (const std::string& value : bound.beyond) {
    const auto [status, text] = run_with(bound, value);
    EXPECT_EQ(status, 2) << value;
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
    EXPECT_NE(text.find(last_key), std::string::npos) << text;
    EXPECT_NE(text.find("--set"), std::string::npos) << text;
  }
}

const std::string base_keys = "robot_types.rackham.base.", odometry_keys = base_keys + "odometry.",
                  laser_keys = "robots.a.lasers.laser.", module_keys = "robots.a.modules.";

INSTANTIATE_TEST_SUITE_P(
    Scenario, Bounds,
    testing::Values(Bound{"room.yaml", "until_s", {"1e-6", "1e9"}, {"1e-7", "1e10", "nan"}},
                    Bound{"room.yaml", "world.step_ms", {"1000"}, {"1e-4", "1001", "0"}},
                    Bound{"room.yaml", "world.shapes.post.radius_m", {"0.0001"}, {"1e-5", "1e6", "1e308"}},
                    Bound{"room.yaml", "world.shapes.post.low_m", {"0", "1.99"}, {"-1", "1e6"}},
                    Bound{"room.yaml", odometry_keys + "turn_noise_rad_per_sqrt_m", {"0", "10"}, {"11", "1e9"}},
                    Bound{"room.yaml", odometry_keys + "turn_noise_rad_per_sqrt_rad", {"10"}, {"1e9"}},
                    Bound{"room.yaml", odometry_keys + "drift_rad_per_m", {"-10", "10"}, {"-11", "1e300"}},
                    Bound{"room.yaml", odometry_keys + "slip_turn_rad", {"10"}, {"-1", "1e9"}},
                    Bound{"room.yaml", odometry_keys + "slips_per_m", {"1000"}, {"1001"}},
                    Bound{"room.yaml", odometry_keys + "units_per_m", {"0.001", "1e9"}, {"0", "1e-4", "1e10"}},
                    Bound{"room.yaml", odometry_keys + "travel_scale", {"0.001", "1000"}, {"0", "1e4"}},
                    Bound{"room.yaml", base_keys + "v_max_m_s", {"1e-12", "10000"}, {"0", "1e-13", "10001"}},
                    Bound{"room.yaml", base_keys + "w_max_rad_s", {"1e-12", "10000"}, {"-1", "1e5"}},
                    Bound{"room.yaml", base_keys + "v_acceleration_m_s2", {"1e-6", "1e6"}, {"1e-7", "1e7"}},
                    Bound{"room.yaml", base_keys + "w_acceleration_rad_s2", {"1e-6", "1e6"}, {"1e-7", "1e7"}},
                    Bound{"room.yaml", base_keys + "watchdog_ms", {"0.001", "1e9"}, {"1e-4", "1e10"}}));

INSTANTIATE_TEST_SUITE_P(
    Sensors, Bounds,
    testing::Values(
        Bound{"settings.yaml", laser_keys + "height_m", {"0", "100000"}, {"-1", "1e6"}},
        Bound{"settings.yaml", laser_keys + "resolution_m", {"0.000001", "1000"}, {"0", "1e-7", "1e4"}},
        Bound{"settings.yaml", laser_keys + "range_max_m", {"0.0001", "100000"}, {"0", "1e-5", "1e300"}},
        Bound{"settings.yaml", laser_keys + "range_noise_m", {"0", "100000"}, {"-1", "1e6"}},
        Bound{"settings.yaml", laser_keys + "noise_growth", {"1", "1000"}, {"0.9", "1e9"}},
        Bound{"settings.yaml", laser_keys + "warm_up_s", {"0.001", "1e9"}, {"0", "1e-4", "1e10"}},
        Bound{"sensors.yaml", "robots.a.sonars.0.range_max_m", {"0.2"}, {"1e6", "0"}},
        Bound{"sensors.yaml", "robots.a.imu.gyro_rad_s.drift_s", {"0.001", "1e9"}, {"0", "1e-300"}},
        Bound{"sensors.yaml", "robots.a.imu.accelerometer_m_s2.resolution", {"0", "0.000001", "1000"}, {"1e-7", "1e4"}},
        Bound{"sensors.yaml", "robots.a.gps.noise_m", {"0", "100000"}, {"-1", "1e300"}},
        Bound{"sensors.yaml", "robots.a.gps.resolution_m", {"0", "0.000001"}, {"1e-9", "-1"}},
        Bound{"sensors.yaml", "robots.a.infrareds.resolution_v", {"0.000001", "1000"}, {"0", "1e-300"}},
        Bound{"sensors.yaml", "robots.a.base.effective_axle_ratio", {"1", "1000"}, {"0.5", "1e9"}},
        Bound{"air.yaml", "robots.flyer.battery.capacity_ah", {"0.000001", "1000000"}, {"0", "1e-300"}},
        Bound{"air.yaml", "robots.flyer.battery.resolution_v", {"0", "0.000001"}, {"1e-12"}},
        Bound{"air.yaml", "robots.flyer.battery.idle_a", {"0", "1000000"}, {"-1", "1e9"}},
        Bound{"air.yaml", "robots.flyer.start_height_m", {"0"}, {"-1", "1e6"}},
        Bound{"air.yaml", "medium.latency_ms", {"0.000001", "3600000"}, {"0", "1e9"}},
        Bound{"air.yaml", "medium.range_m", {"0.001", "1e9"}, {"0", "1e10"}}));

INSTANTIATE_TEST_SUITE_P(
    Modules, Bounds,
    testing::Values(
        Bound{"settings.yaml", module_keys + "rflex.units_per_m", {"0.001", "1e12"}, {"0", "-5", "1e13"}},
        Bound{"settings.yaml", module_keys + "rflex.climb_m_s_max", {"0", "10000"}, {"1e5"}},
        Bound{"settings.yaml", module_keys + "rflex.noise.travel_variance_m2_per_m", {"0", "1e12"}, {"-1", "1e-300"}},
        Bound{"settings.yaml", module_keys + "sick.segments.bearing_noise_rad", {"0", "1000"}, {"1e9", "-1"}},
        Bound{"settings.yaml", module_keys + "segloc.angle_rad_max", {"0", "1000"}, {"1e9", "-1"}},
        Bound{"settings.yaml", module_keys + "pom.extrapolation_s_max", {"0", "1e9"}, {"1e12", "-1"}},
        Bound{"settings.yaml", module_keys + "ndd.memory_age_s", {"0", "1e9"}, {"1e12", "-1"}},
        Bound{"settings.yaml", module_keys + "ndd.v_m_s_max", {"0", "10000"}, {"1e9", "-1"}},
        Bound{"room.yaml", "robots.a.executive.mission.wait_s_max", {"0", "1e9"}, {"1e12", "-1"}},
        Bound{"room.yaml", "robots.a.executive.planning.leg_m_max", {"0.05", "100000"}, {"0", "1e-300"}},
        Bound{"room.yaml", "robots.a.executive.planning.escape_m_max", {"0", "100"}, {"101", "1e9"}}));

}  // namespace
}  // namespace waitpoint
