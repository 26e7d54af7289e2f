// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/sensor_reader.hpp"

#include "tests/modules/scenario/bad_case.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

TEST(SensorReader, LmsHasDataSheetDefaults) {
  const auto laser_of = [&](const std::string& keys) {
    const TemporaryFolder folder;
    const auto file = folder.write("s.yaml", changed("beams: 181", keys));
    return read_scenario(file).robots.at(0).body.sensors<world::Lasers>().at(0);
  };
  const world::LaserDescription lms_200 = laser_of("model: lms200");
  EXPECT_EQ(lms_200.beams, 361u);
  EXPECT_EQ(lms_200.interlaced_turns, 2u);
  EXPECT_EQ(lms_200.range_max_m, 81.91);
  EXPECT_EQ(lms_200.noise_growth, 2);
  EXPECT_EQ(lms_200.period, Duration(26666666ns));
  const world::LaserDescription lms_291 = laser_of("model: lms291, beams: 181, line_bit_s: 38400, dropout: 0.01");
  EXPECT_EQ(lms_291.interlaced_turns, 1u);
  EXPECT_EQ(lms_291.range_noise_m, 0.01);
  EXPECT_EQ(lms_291.noise_growth, 1);
  EXPECT_EQ(lms_291.period, Duration(96875us)) << "ten a second, by the line";
  EXPECT_EQ(lms_291.dropout, 0.01);
  EXPECT_EQ(laser_of("model: lms200, resolution_m: 0.001").range_max_m, 8.191);
  EXPECT_EQ(laser_of("beams: 181").mirror_turn, Duration()) << "a generic one has none of these";
}

TEST(SensorReader, ImuGpsAndBatteryAreOffByDefault) {
  const TemporaryFolder folder;
  const world::BodyDescription none = read_scenario(folder.write("s.yaml", valid_scenario)).robots.at(0).body;
  EXPECT_FALSE(none.sensors<world::Imu>() || none.sensors<world::Gps>() || none.sensors<world::Battery>());
  const std::string keys =
      "    imu: {gyro_rad_s: {noise_per_sqrt_hz: 0.001, bias: 0.02}, accelerometer_m_s2: {max: 20}}\n"
      "    gps: {antenna_m: [0.1, -0.2], drift_m: 3, period_ms: 200}\n"
      "    battery: {capacity_ah: 12, peukert: 1.2, charge: 0.5}\n    sonars:";
  const auto file = folder.write("t.yaml", changed("    sonars:", keys));
  const world::BodyDescription body = read_scenario(file).robots.at(0).body;
  EXPECT_EQ(body.sensors<world::Imu>()->gyro.noise_per_sqrt_hz, 0.001);
  EXPECT_EQ(body.sensors<world::Imu>()->gyro.bias, 0.02);
  EXPECT_EQ(body.sensors<world::Imu>()->gyro.walk_per_sqrt_s, 0);
  EXPECT_EQ(body.sensors<world::Imu>()->accelerometer.bias, 0);
  EXPECT_EQ(body.sensors<world::Imu>()->accelerometer.max, 20);
  EXPECT_EQ(body.sensors<world::Imu>()->period, Duration(10ms));
  EXPECT_EQ(body.sensors<world::Gps>()->antenna, (Point{0.1, -0.2}));
  EXPECT_EQ(body.sensors<world::Gps>()->drift_m, 3);
  EXPECT_EQ(body.sensors<world::Gps>()->noise_m, 0);
  EXPECT_EQ(body.sensors<world::Gps>()->period, Duration(200ms));
  EXPECT_EQ(body.sensors<world::Battery>()->capacity_ah, 12);
  EXPECT_EQ(body.sensors<world::Battery>()->peukert, 1.2);
  EXPECT_EQ(body.sensors<world::Battery>()->charge, 0.5);
  EXPECT_EQ(body.sensors<world::Battery>()->off_v, 0);
}

class BadSensor : public ::testing::TestWithParam<BadCase> {};

TEST_P(BadSensor, IsReportedInOneLineWithFileAndLine) { expect_complaint(GetParam()); }

const BadCase bad_sensors[] = {
    {"a_laser_that_nobody_makes", "beams: 181", "model: lms100", 19,
     "expected model to be generic, lms200 or lms291, found 'lms100'"},
    {"an_lms_with_a_beam_each_third_of_a_degree", "beams: 181", "model: lms200, beams: 541", 19,
     "expected an LMS to have a beam each degree or half a degree, or each quarter over 100 degrees"},
    {"an_lms_that_looks_behind", "beams: 181", "model: lms291, field_of_view_deg: 270", 19,
     "expected an LMS to look over 90, 100 or 180 degrees"},
    {"an_lms_beyond_its_numbers", "beams: 181", "model: lms200, resolution_m: 0.001, range_max_m: 20", 19,
     "expected range_max_m to be at most 8191 times resolution_m, found '20'"},
    {"scans_faster_than_their_line", "beams: 181", "model: lms200, line_bit_s: 38400, period_ms: 100", 19,
     "expected period_ms to be at least 190.625000000: the time of a scan at the mirror or on the line"},
    {"scans_faster_than_the_mirror", "beams: 181", "mirror_turn_ms: 60, interlaced_turns: 2", 19,
     "expected period_ms to be at least 120.000000000: the time of a scan at the mirror or on the line"},
    {"a_line_of_no_speed", "beams: 181", "line_bit_s: 0", 19,
     "expected line_bit_s to be a whole number from 300 to 1000000000, found '0'"},
    {"a_dropout_above_one", "beams: 181", "dropout: 1.1", 19,
     "expected dropout to be a probability from 0 to 1, found '1.1'"},
    {"noise_that_shrinks", "beams: 181", "noise_growth: 0.5", 19,
     "expected noise_growth to be a number from 1 to 1000, found '0.5'"},
    {"an_unsteady_laser", "beams: 181", "angle_noise_deg: 11", 19,
     "expected angle_noise_deg to be degrees from 0 to 10, found '11'"},
    {"a_spot_as_wide_as_a_door", "beams: 181", "spot_m: 1", 19,
     "expected spot_m to be a width from 0 to 0.1 m, found '1'"},
    {"light_that_scatters", "beams: 181", "spot_divergence_rad: 1", 19,
     "expected spot_divergence_rad to be an angle from 0 to 0.1 rad, found '1'"},
    {"a_jump_of_nothing", "beams: 181", "mixed_jump_m: 0", 19,
     "expected mixed_jump_m to be a length from 0.0001 to 100000 m, found '0'"},
    {"an_incidence_from_behind", "beams: 181", "incidence_max_deg: 91", 19,
     "expected incidence_max_deg to be degrees above 0, at most 90, found '91'"},
    {"a_turn_for_nobody", "- {count: 24}", "- {count: 24, firing_order: [0, 1, 4, 2]}", 21,
     "expected a member of firing_order to be a whole number from 0 to 3, found '4'"},
    {"a_turn_twice", "- {count: 24}", "- {count: 24, firing_order: [0, 1, 1, 2]}", 21,
     "expected each member of a bank once in firing_order, found '1' twice"},
    {"turns_without_anybody", "- {count: 24}", "- {count: 24, firing_order: []}", 21,
     "expected firing_order to have from 1 to 24 members, found 0"},
    {"turns_faster_than_sound", "- {count: 24}", "- {count: 24, firing_order: [0, 1, 2, 3], period_ms: 60}", 21,
     "expected period_ms to be at least 69.885272000: each turn waits for echoes from range_max_m"},
    {"sonars_on_the_moon", "- {count: 24}", "- {count: 24, air_celsius: -170}", 21,
     "expected air_celsius to be degrees from -60 to 60, found '-170'"},
    {"more_sonars_than_there_is_room_for", "      - {count: 24}", "      - {count: 24}\n      - {count: 25}", 21,
     "expected 48 sonars at most, found 49"},
    {"too_many_panels", "    sonars:", "    bumpers: {count: 33}\n    sonars:", 20,
     "expected count to be a whole number from 1 to 32, found '33'"},
    {"a_bumper_that_nothing_can_touch", "    sonars:", "    bumpers: {travel_m: 0}\n    sonars:", 20,
     "expected travel_m to be a distance from 0.00001 to 0.1 m, found '0'"},
    {"infrared_without_reach", "    sonars:", "    infrareds: {range_max_m: 0.05}\n    sonars:", 20,
     "expected range_max_m to be above range_min_m"},
    {"infrared_that_grows_with_the_range", "    sonars:", "    infrareds: {exponent: 1}\n    sonars:", 20,
     "expected exponent to be a number from -10 to -0.1, found '1'"},
    {"a_gyro_in_other_units", "    sonars:", "    imu: {gyro_deg_s: {bias: 1}}\n    sonars:", 20,
     "unknown key 'gyro_deg_s' in the imu, did you mean 'gyro_rad_s'?"},
    {"an_imu_without_time", "    sonars:", "    imu: {period_ms: 0}\n    sonars:", 20,
     "expected period_ms to be a positive number, found '0'"},
    {"a_gyro_of_bad_noise_per_sqrt_hz", "    sonars:", "    imu: {gyro_rad_s: {noise_per_sqrt_hz: -1}}\n    sonars:",
     20, "expected noise_per_sqrt_hz to be a number from 0 to 1000, found '-1'"},
    {"a_gyro_of_bad_bias", "    sonars:", "    imu: {gyro_rad_s: {bias: -1}}\n    sonars:", 20,
     "expected bias to be a number from 0 to 1000, found '-1'"},
    {"a_gyro_of_bad_walk_per_sqrt_s", "    sonars:", "    imu: {gyro_rad_s: {walk_per_sqrt_s: -1}}\n    sonars:", 20,
     "expected walk_per_sqrt_s to be a number from 0 to 1000, found '-1'"},
    {"a_gyro_of_bad_drift", "    sonars:", "    imu: {gyro_rad_s: {drift: -1}}\n    sonars:", 20,
     "expected drift to be a number from 0 to 1000, found '-1'"},
    {"a_gyro_of_bad_resolution", "    sonars:", "    imu: {gyro_rad_s: {resolution: -1}}\n    sonars:", 20,
     "expected resolution to be 0, or a resolution from 0.000001 to 1000, found '-1'"},
    {"an_accelerometer_of_bad_drift_s", "    sonars:", "    imu: {accelerometer_m_s2: {drift_s: 0}}\n    sonars:", 20,
     "expected drift_s to be a number of seconds from 0.001 to 1e9, found '0'"},
    {"an_accelerometer_of_bad_scale", "    sonars:", "    imu: {accelerometer_m_s2: {scale: 0}}\n    sonars:", 20,
     "expected scale to be a factor from 0.001 to 1000, found '0'"},
    {"an_accelerometer_of_bad_max", "    sonars:", "    imu: {accelerometer_m_s2: {max: 0}}\n    sonars:", 20,
     "expected max to be a positive number, found '0'"},
    {"an_antenna_without_a_place", "    sonars:", "    gps: {antenna_m: here}\n    sonars:", 20,
     "expected antenna_m to be a list of 2 numbers, found 'here'"},
    {"a_bias_of_no_number", "    sonars:", "    gps: {bias_x_m: east}\n    sonars:", 20,
     "expected bias_x_m to be a coordinate within 100 km, found 'east'"},
    {"the_other_bias_of_no_number", "    sonars:", "    gps: {bias_y_m: .inf}\n    sonars:", 20,
     "expected bias_y_m to be a coordinate within 100 km, found '.inf'"},
    {"a_receiver_of_bad_drift_m", "    sonars:", "    gps: {drift_m: -1}\n    sonars:", 20,
     "expected drift_m to be a number of metres from 0 to 100000, found '-1'"},
    {"a_receiver_of_bad_noise_m", "    sonars:", "    gps: {noise_m: -1}\n    sonars:", 20,
     "expected noise_m to be a number of metres from 0 to 100000, found '-1'"},
    {"a_receiver_of_bad_height_factor", "    sonars:", "    gps: {height_factor: -1}\n    sonars:", 20,
     "expected height_factor to be a number from 0 to 1000, found '-1'"},
    {"a_receiver_of_bad_resolution_m", "    sonars:", "    gps: {resolution_m: -1}\n    sonars:", 20,
     "expected resolution_m to be 0, or a resolution from 0.000001 to 1000, found '-1'"},
    {"a_receiver_of_bad_drift_s", "    sonars:", "    gps: {drift_s: 0}\n    sonars:", 20,
     "expected drift_s to be a number of seconds from 0.001 to 1e9, found '0'"},
    {"fixes_that_fail_too_often", "    sonars:", "    gps: {dropout: 2}\n    sonars:", 20,
     "expected dropout to be a probability from 0 to 1, found '2'"},
    {"fixes_without_time", "    sonars:", "    gps: {period_ms: -5}\n    sonars:", 20,
     "expected period_ms to be a positive number, found '-5'"},
    {"a_battery_of_bad_volts_full", "    sonars:", "    battery: {volts_full: 0}\n    sonars:", 20,
     "expected volts_empty to be at most volts_full"},
    {"a_battery_of_bad_capacity_ah", "    sonars:", "    battery: {capacity_ah: 0}\n    sonars:", 20,
     "expected capacity_ah to be a number from 0.000001 to 1000000, found '0'"},
    {"a_battery_of_bad_rated_h", "    sonars:", "    battery: {rated_h: 0}\n    sonars:", 20,
     "expected rated_h to be a number from 0.000001 to 1000000, found '0'"},
    {"a_battery_of_bad_volts_empty", "    sonars:", "    battery: {volts_empty: -1}\n    sonars:", 20,
     "expected volts_empty to be a number of volts from 0 to 100000, found '-1'"},
    {"a_battery_of_bad_resistance_ohm", "    sonars:", "    battery: {resistance_ohm: -1}\n    sonars:", 20,
     "expected resistance_ohm to be a number from 0 to 1000000, found '-1'"},
    {"a_battery_of_bad_resolution_v", "    sonars:", "    battery: {resolution_v: -1}\n    sonars:", 20,
     "expected resolution_v to be 0, or a resolution from 0.000001 to 1000, found '-1'"},
    {"a_battery_of_bad_off_v", "    sonars:", "    battery: {off_v: -1}\n    sonars:", 20,
     "expected off_v to be a number of volts from 0 to 100000, found '-1'"},
    {"a_battery_of_bad_idle_a", "    sonars:", "    battery: {idle_a: -1}\n    sonars:", 20,
     "expected idle_a to be a number from 0 to 1000000, found '-1'"},
    {"a_battery_of_bad_drive_a_per_m_s", "    sonars:", "    battery: {drive_a_per_m_s: -1}\n    sonars:", 20,
     "expected drive_a_per_m_s to be a number from 0 to 1000000, found '-1'"},
    {"a_battery_of_bad_turn_a_per_rad_s", "    sonars:", "    battery: {turn_a_per_rad_s: -1}\n    sonars:", 20,
     "expected turn_a_per_rad_s to be a number from 0 to 1000000, found '-1'"},
    {"a_battery_of_bad_climb_a_per_m_s", "    sonars:", "    battery: {climb_a_per_m_s: -1}\n    sonars:", 20,
     "expected climb_a_per_m_s to be a number from 0 to 1000000, found '-1'"},
    {"a_battery_of_bad_stalled_a", "    sonars:", "    battery: {stalled_a: -1}\n    sonars:", 20,
     "expected stalled_a to be a number from 0 to 1000000, found '-1'"},
    {"a_battery_that_is_fuller_when_empty", "    sonars:", "    battery: {volts_empty: 30}\n    sonars:", 20,
     "expected volts_empty to be at most volts_full"},
    {"a_battery_beyond_peukert", "    sonars:", "    battery: {peukert: 0.9}\n    sonars:", 20,
     "expected peukert to be a number from 1 to 2, found '0.9'"},
    {"a_battery_without_charge", "    sonars:", "    battery: {charge: 0}\n    sonars:", 20,
     "expected charge to be a part above 0, at most 1, found '0'"},
    {"two_batteries", "    lasers:", "      battery_capacity_s: 100\n    battery: {}\n    lasers:", 18,
     "expected either battery or the base's battery_capacity_s"},
};

INSTANTIATE_TEST_SUITE_P(Scenario, BadSensor, ::testing::ValuesIn(bad_sensors),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace waitpoint::scenario
