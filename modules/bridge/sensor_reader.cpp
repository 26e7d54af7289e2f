// SPDX-License-Identifier: BSD-3-Clause
#include "modules/bridge/sensor_reader.hpp"

#include <algorithm>

#include "modules/bridge/shape_reader.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/laser.hpp"
#include "world/sensors/laser_models.hpp"
#include "world/sensors/laser_timing.hpp"
#include "world/sensors/sonar.hpp"

namespace waitpoint::bridge {
namespace {

using namespace std::chrono_literals;

constexpr NumberRange probability{0, 1, "a probability from 0 to 1"};

/// The errors of a laser that stand alone.
void read_laser_errors(const YamlMap& map, world::LaserDescription& laser) {
  laser.range_noise_m = map.number("range_noise_m", number_from_zero, laser.range_noise_m);
  constexpr NumberRange growth{1, 1e9, "a number from 1 on"};
  laser.noise_growth = map.number("noise_growth", growth, laser.noise_growth);
  laser.range_bias_m = map.number("range_bias_m", any_number, laser.range_bias_m);
  laser.warm_up_bias_m = map.number("warm_up_bias_m", any_number, laser.warm_up_bias_m);
  laser.warm_up_s = map.number("warm_up_s", positive_number, laser.warm_up_s);
  constexpr NumberRange jitter{0, 10, "degrees from 0 to 10"};
  laser.angle_noise_rad = map.degrees("angle_noise_deg", jitter, laser.angle_noise_rad);
  constexpr NumberRange width{0, 0.1, "a width from 0 to 0.1 m"};
  laser.spot_m = map.number("spot_m", width, laser.spot_m);
  constexpr NumberRange divergence{0, 0.1, "an angle from 0 to 0.1 rad"};
  laser.spot_divergence_rad = map.number("spot_divergence_rad", divergence, laser.spot_divergence_rad);
  laser.mixed_jump_m = map.number("mixed_jump_m", positive_number, laser.mixed_jump_m);
  laser.dropout = map.number("dropout", probability, laser.dropout);
  constexpr NumberRange incidence{least_positive, 90, "degrees above 0, at most 90"};
  laser.incidence_max_rad = map.degrees("incidence_max_deg", incidence, laser.incidence_max_rad);
}

/// What mirror and line can do, and what an LMS can.
void read_laser_timing(const YamlMap& map, bool lms, world::LaserDescription& laser) {
  constexpr std::uint64_t line_max_bit_s = 1'000'000'000;
  laser.line_bit_s = static_cast<std::uint32_t>(map.count("line_bit_s", 300, line_max_bit_s, laser.line_bit_s));
  laser.mirror_turn = map.duration("mirror_turn_ms", 1ms, laser.mirror_turn);
  constexpr std::uint64_t turns_max = 16;
  if (!lms) {
    laser.interlaced_turns =
        static_cast<std::uint32_t>(map.count("interlaced_turns", 1, turns_max, laser.interlaced_turns));
  } else if (const auto cannot = set_lms_mode(laser)) {
    throw map.node().written.bad(*cannot);
  }
  const Duration least = world::least_period(laser);
  laser.period = map.duration("period_ms", 1ms, lms ? least : laser.period);
  if (laser.period < least) {
    throw map.node().written.bad("expected period_ms to be at least " + to_string(least * 1000) +
                                 ": mirror and line take that for a scan");
  }
}

/// Of one sort of axes, in the unit that the key of `node` names.
world::InertialErrors read_inertial_errors(const YamlNode& node, std::string_view what) {
  const YamlMap map(node, std::string(what),
                    {"noise_per_sqrt_hz", "bias", "walk_per_sqrt_s", "drift", "drift_s", "scale", "resolution", "max"});
  world::InertialErrors errors;
  errors.noise_per_sqrt_hz = map.number("noise_per_sqrt_hz", number_from_zero, errors.noise_per_sqrt_hz);
  errors.bias = map.number("bias", number_from_zero, errors.bias);
  errors.walk_per_sqrt_s = map.number("walk_per_sqrt_s", number_from_zero, errors.walk_per_sqrt_s);
  errors.drift = map.number("drift", number_from_zero, errors.drift);
  errors.drift_s = map.number("drift_s", positive_number, errors.drift_s);
  errors.scale = map.number("scale", positive_number, errors.scale);
  errors.resolution = map.number("resolution", number_from_zero, errors.resolution);
  errors.max = map.number("max", positive_number, errors.max);
  return errors;
}

/// Each member of a bank once, and time for the echo of each slot to come back before the next.
void read_firing_order(const YamlNode& node, world::SonarRingDescription& ring) {
  const std::vector<YamlNode>& members = read_list(node, "firing_order");
  if (members.empty() || members.size() > ring.count)
    throw node.written.bad("expected firing_order to have from 1 to as many members as the ring");
  for (const YamlNode& member : members) {
    const std::uint64_t number = read_count(member, "a member of firing_order", 0, members.size() - 1);
    if (std::count(ring.firing_order.begin(), ring.firing_order.end(), number) > 0)
      throw member.written.bad("expected each member of a bank once in firing_order, '" + member.text +
                               "' is there already");
    ring.firing_order.push_back(static_cast<std::uint32_t>(number));
  }
  const double echo_s = 2 * ring.range_max_m / world::sound_m_s(ring.air_celsius);
  const Duration least = Duration::from_seconds(echo_s) * static_cast<std::int64_t>(members.size());
  if (ring.period < least)
    throw node.written.bad("expected period_ms to be at least " + to_string(least * 1000) +
                           ": each turn waits for echoes from range_max_m");
}

}  // namespace

LaserReading read_laser(const YamlNode& node) {
  const YamlMap map(node, "a laser",
                    {"name",
                     "model",
                     "mount",
                     "frame",
                     "height_m",
                     "beams",
                     "field_of_view_deg",
                     "range_max_m",
                     "range_noise_m",
                     "noise_growth",
                     "range_bias_m",
                     "warm_up_bias_m",
                     "warm_up_s",
                     "angle_noise_deg",
                     "resolution_m",
                     "period_ms",
                     "mirror_turn_ms",
                     "interlaced_turns",
                     "spot_m",
                     "spot_divergence_rad",
                     "mixed_jump_m",
                     "dropout",
                     "incidence_max_deg",
                     "line_bit_s"});
  const std::size_t model = map.one_of("model", {"generic", "lms200", "lms291"}, 0);
  const bool lms = model != 0;
  LaserReading reading;
  world::LaserDescription& laser = reading.laser;
  if (lms) laser = model == 1 ? world::lms_200() : world::lms_291();
  reading.name = map.text("name", "laser");
  if (const YamlNode* mount = map.find("mount")) laser.mount = read_pose(*mount, "mount");
  laser.height_m = map.number("height_m", number_from_zero, laser.height_m);
  laser.beams = static_cast<std::uint32_t>(map.count("beams", 2, posters::beam_count_max, laser.beams));
  constexpr NumberRange fan{least_positive, 360, "degrees above 0, at most 360"};
  laser.field_of_view_rad = map.degrees("field_of_view_deg", fan, laser.field_of_view_rad);
  laser.resolution_m = map.number("resolution_m", positive_number, laser.resolution_m);
  if (lms) laser.range_max_m = world::lms_range_max_m(laser.resolution_m);
  const double has_numbers_to_m = laser.range_max_m;
  laser.range_max_m = map.number("range_max_m", positive_number, laser.range_max_m);
  if (lms && laser.range_max_m > has_numbers_to_m) {
    throw map.require("range_max_m")
        .written.bad("expected range_max_m to be at most 8191 times resolution_m, found '" + map.text("range_max_m") +
                     "'");
  }
  read_laser_errors(map, laser);
  read_laser_timing(map, lms, laser);
  return reading;
}

world::SonarRingDescription read_sonar_ring(const YamlNode& node) {
  const YamlMap map(
      node, "a ring of sonars",
      {"count", "ring_radius_m", "height_m", "half_cone_deg", "range_min_m", "range_max_m", "range_noise_relative",
       "period_ms", "firing_order", "crosstalk", "air_celsius", "calibrated_celsius"});
  world::SonarRingDescription ring;
  ring.count = static_cast<std::uint32_t>(map.count("count", 1, posters::sonar_count_max, ring.count));
  ring.ring_radius_m = map.number("ring_radius_m", number_from_zero, ring.ring_radius_m);
  ring.height_m = map.number("height_m", number_from_zero, ring.height_m);
  constexpr NumberRange cone{least_positive, 90, "degrees above 0, at most 90"};
  ring.half_cone_rad = map.degrees("half_cone_deg", cone, ring.half_cone_rad);
  ring.range_min_m = map.number("range_min_m", number_from_zero, ring.range_min_m);
  ring.range_max_m = map.number("range_max_m", positive_number, ring.range_max_m);
  if (ring.range_max_m <= ring.range_min_m) throw node.written.bad("expected range_max_m to be above range_min_m");
  ring.range_noise_relative = map.number("range_noise_relative", number_from_zero, ring.range_noise_relative);
  ring.period = map.duration("period_ms", 1ms, ring.period);
  constexpr NumberRange celsius{-60, 60, "degrees from -60 to 60"};
  ring.air_celsius = map.number("air_celsius", celsius, ring.air_celsius);
  ring.calibrated_celsius = map.number("calibrated_celsius", celsius, ring.calibrated_celsius);
  ring.crosstalk = map.truth("crosstalk", ring.crosstalk);
  if (const YamlNode* order = map.find("firing_order")) read_firing_order(*order, ring);
  return ring;
}

world::BumperDescription read_bumpers(const YamlNode& node) {
  const YamlMap map(node, "the bumpers", {"count", "travel_m"});
  world::BumperDescription bumpers;
  bumpers.count = static_cast<std::uint32_t>(map.count("count", 1, posters::bumper_count_max, bumpers.count));
  constexpr NumberRange travel{1e-5, 0.1, "a distance from 0.00001 to 0.1 m"};  // bodies stop a little before contact
  bumpers.travel_m = map.number("travel_m", travel, bumpers.travel_m);
  return bumpers;
}

world::InfraredRingDescription read_infrareds(const YamlNode& node) {
  const YamlMap map(node, "the infrared range finders",
                    {"count", "ring_radius_m", "height_m", "range_min_m", "range_max_m", "gain_per_v", "exponent",
                     "noise_v", "resolution_v", "period_ms"});
  world::InfraredRingDescription ring;
  ring.count = static_cast<std::uint32_t>(map.count("count", 1, posters::infrared_count_max, ring.count));
  ring.ring_radius_m = map.number("ring_radius_m", number_from_zero, ring.ring_radius_m);
  ring.height_m = map.number("height_m", number_from_zero, ring.height_m);
  ring.range_min_m = map.number("range_min_m", positive_number, ring.range_min_m);
  ring.range_max_m = map.number("range_max_m", positive_number, ring.range_max_m);
  if (ring.range_max_m <= ring.range_min_m) throw node.written.bad("expected range_max_m to be above range_min_m");
  ring.gain_per_v = map.number("gain_per_v", positive_number, ring.gain_per_v);
  constexpr NumberRange falling{-10, -0.1, "a number from -10 to -0.1"};
  ring.exponent = map.number("exponent", falling, ring.exponent);
  ring.noise_v = map.number("noise_v", number_from_zero, ring.noise_v);
  ring.resolution_v = map.number("resolution_v", positive_number, ring.resolution_v);
  ring.period = map.duration("period_ms", 1ms, ring.period);
  return ring;
}

world::ImuDescription read_imu(const YamlNode& node) {
  const YamlMap map(node, "the imu", {"gyro_rad_s", "accelerometer_m_s2", "period_ms"});
  world::ImuDescription imu;
  if (const YamlNode* gyro = map.find("gyro_rad_s")) imu.gyro = read_inertial_errors(*gyro, "gyro_rad_s");
  if (const YamlNode* accelerometer = map.find("accelerometer_m_s2"))
    imu.accelerometer = read_inertial_errors(*accelerometer, "accelerometer_m_s2");
  imu.period = map.duration("period_ms", 1ms, imu.period);
  return imu;
}

world::PositionReceiverDescription read_gps(const YamlNode& node) {
  const YamlMap map(node, "the gps",
                    {"antenna_m", "bias_x_m", "bias_y_m", "drift_m", "drift_s", "noise_m", "height_factor",
                     "resolution_m", "dropout", "period_ms"});
  world::PositionReceiverDescription gps;
  if (const YamlNode* antenna = map.find("antenna_m")) gps.antenna = read_point(*antenna, "antenna_m");
  gps.bias_x_m = map.number("bias_x_m", any_number, gps.bias_x_m);
  gps.bias_y_m = map.number("bias_y_m", any_number, gps.bias_y_m);
  gps.drift_m = map.number("drift_m", number_from_zero, gps.drift_m);
  gps.drift_s = map.number("drift_s", positive_number, gps.drift_s);
  gps.noise_m = map.number("noise_m", number_from_zero, gps.noise_m);
  gps.height_factor = map.number("height_factor", number_from_zero, gps.height_factor);
  gps.resolution_m = map.number("resolution_m", number_from_zero, gps.resolution_m);
  gps.dropout = map.number("dropout", probability, gps.dropout);
  gps.period = map.duration("period_ms", 1ms, gps.period);
  return gps;
}

}  // namespace waitpoint::bridge
