// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/sensor_reader.hpp"

#include "tests/modules/bridge/bad_case.hpp"

namespace waitpoint::bridge {
namespace {

using namespace std::chrono_literals;

TEST(SensorReader, an_lms_is_what_its_data_sheet_says_but_for_what_is_given) {
  const auto laser_of = [&](const std::string& keys) {
    const TemporaryFolder folder;
    const auto file = folder.write("s.yaml", changed("beams: 181", keys));
    return read_scenario(file).robots.at(0).body.lasers.at(0);
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

class BadSensor : public ::testing::TestWithParam<BadCase> {};

TEST_P(BadSensor, is_one_line_that_names_file_line_and_what_was_expected) { expect_complaint(GetParam()); }

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
     "expected period_ms to be at least 190.625000000: mirror and line take that for a scan"},
    {"scans_faster_than_the_mirror", "beams: 181", "mirror_turn_ms: 60, interlaced_turns: 2", 19,
     "expected period_ms to be at least 120.000000000: mirror and line take that for a scan"},
    {"a_line_of_no_speed", "beams: 181", "line_bit_s: 0", 19,
     "expected line_bit_s to be a whole number from 300 to 1000000000, found '0'"},
    {"a_dropout_above_one", "beams: 181", "dropout: 1.1", 19,
     "expected dropout to be a probability from 0 to 1, found '1.1'"},
    {"noise_that_shrinks", "beams: 181", "noise_growth: 0.5", 19,
     "expected noise_growth to be a number from 1 on, found '0.5'"},
    {"an_unsteady_laser", "beams: 181", "angle_noise_deg: 11", 19,
     "expected angle_noise_deg to be degrees from 0 to 10, found '11'"},
    {"a_spot_as_wide_as_a_door", "beams: 181", "spot_m: 1", 19,
     "expected spot_m to be a width from 0 to 0.1 m, found '1'"},
    {"light_that_scatters", "beams: 181", "spot_divergence_rad: 1", 19,
     "expected spot_divergence_rad to be an angle from 0 to 0.1 rad, found '1'"},
    {"a_jump_of_nothing", "beams: 181", "mixed_jump_m: 0", 19,
     "expected mixed_jump_m to be a positive number, found '0'"},
    {"an_incidence_from_behind", "beams: 181", "incidence_max_deg: 91", 19,
     "expected incidence_max_deg to be degrees above 0, at most 90, found '91'"},
    {"a_turn_for_nobody", "- {count: 24}", "- {count: 24, firing_order: [0, 1, 4, 2]}", 21,
     "expected a member of firing_order to be a whole number from 0 to 3, found '4'"},
    {"a_turn_twice", "- {count: 24}", "- {count: 24, firing_order: [0, 1, 1, 2]}", 21,
     "expected each member of a bank once in firing_order, '1' is there already"},
    {"turns_without_anybody", "- {count: 24}", "- {count: 24, firing_order: []}", 21,
     "expected firing_order to have from 1 to as many members as the ring"},
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
};

INSTANTIATE_TEST_SUITE_P(Scenario, BadSensor, ::testing::ValuesIn(bad_sensors),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace waitpoint::bridge
