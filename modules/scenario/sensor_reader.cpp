// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/sensor_reader.hpp"

#include <algorithm>

#include "modules/posters/base.hpp"
#include "modules/posters/laser.hpp"
#include "modules/scenario/keys.hpp"
#include "modules/scenario/shape_reader.hpp"
#include "world/sensors/laser_models.hpp"
#include "world/sensors/laser_timing.hpp"
#include "world/sensors/sonar.hpp"

namespace waitpoint::scenario {
namespace {

using namespace std::chrono_literals;

constexpr NumberRange step{1e-6, 1e3, "a resolution from 0.000001 to 1000"};
constexpr NumberRange probability{0, 1, "a probability from 0 to 1"};

/// Error parameters of a laser that do not depend on others.
void read_laser_errors(const YamlMap& map, world::LaserDescription& laser) {
  map.read("range_noise_m", laser.range_noise_m, ranges::length_error);
  constexpr NumberRange growth{1, 1e3, "a number from 1 to 1000"};
  map.read("noise_growth", laser.noise_growth, growth);
  map.read("range_bias_m", laser.range_bias_m, ranges::coordinate);
  map.read("warm_up_bias_m", laser.warm_up_bias_m, ranges::coordinate);
  map.read("warm_up_s", laser.warm_up_s, ranges::time_constant);
  constexpr NumberRange jitter{0, 10, "degrees from 0 to 10"};
  map.read_degrees("angle_noise_deg", laser.angle_noise_rad, jitter);
  constexpr NumberRange width{0, 0.1, "a width from 0 to 0.1 m"};
  map.read("spot_m", laser.spot_m, width);
  constexpr NumberRange divergence{0, 0.1, "an angle from 0 to 0.1 rad"};
  map.read("spot_divergence_rad", laser.spot_divergence_rad, divergence);
  map.read("mixed_jump_m", laser.mixed_jump_m, ranges::length);
  map.read("dropout", laser.dropout, probability);
  constexpr NumberRange incidence{least_nonzero, 90, "degrees above 0, at most 90"};
  map.read_degrees("incidence_max_deg", laser.incidence_max_rad, incidence);
}

/// Timing of mirror and serial line, within the limits of an LMS if `lms`.
void read_laser_timing(const YamlMap& map, bool lms, world::LaserDescription& laser) {
  constexpr std::uint64_t line_max_bit_s = 1'000'000'000;
  map.read("line_bit_s", laser.line_bit_s, 300, line_max_bit_s);
  map.read("mirror_turn_ms", laser.mirror_turn, 1ms);
  constexpr std::uint64_t waitpoints_max = 16;
  if (!lms) {
    map.read("interlaced_turns", laser.interlaced_turns, 1, waitpoints_max);
  } else if (const auto cannot = set_lms_mode(laser)) {
    throw map.node().written.bad(*cannot);
  }
  const Duration least = world::least_period(laser);
  if (lms) laser.period = least;
  map.read("period_ms", laser.period, 1ms);
  if (laser.period < least) {
    throw map.node().written.bad("expected period_ms to be at least " + to_string(least * 1000) +
                                 ": the time of a scan at the mirror or on the line");
  }
}

/// Common keys of rings of sonars and infrared range finders; `nearest` is the range of range_min_m.
template <class Ring>
void read_ring(const YamlMap& map, std::uint32_t count_max, const NumberRange& nearest, Ring& ring) {
  map.read("count", ring.count, 1, count_max);
  map.read("ring_radius_m", ring.ring_radius_m, ranges::length_error);
  map.read("height_m", ring.height_m, ranges::height);
  map.read("range_min_m", ring.range_min_m, nearest);
  map.read("range_max_m", ring.range_max_m, ranges::length);
  if (ring.range_max_m <= ring.range_min_m)
    throw map.node().written.bad("expected range_max_m to be above range_min_m");
  map.read("period_ms", ring.period, 1ms);
}

/// A permutation of a bank's members; the period must let the echo of each slot return before the next slot.
void read_firing_order(const YamlNode& node, world::SonarRingDescription& ring) {
  const std::vector<YamlNode>& members = read_list(node, "firing_order");
  if (members.empty() || members.size() > ring.count)
    throw node.written.bad("expected firing_order to have from 1 to " + std::to_string(ring.count) +
                           " members, found " + std::to_string(members.size()));
  for (const YamlNode& member : members) {
    const std::uint64_t number = read_count(member, "a member of firing_order", 0, members.size() - 1);
    if (std::count(ring.firing_order.begin(), ring.firing_order.end(), number) > 0)
      throw member.written.bad("expected each member of a bank once in firing_order, found '" + member.text +
                               "' twice");
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
  map.read("height_m", laser.height_m, ranges::height);
  map.read("beams", laser.beams, 2, posters::beam_count_max);
  constexpr NumberRange fan{least_nonzero, 360, "degrees above 0, at most 360"};
  map.read_degrees("field_of_view_deg", laser.field_of_view_rad, fan);
  map.read("resolution_m", laser.resolution_m, step);
  if (lms) laser.range_max_m = world::lms_range_max_m(laser.resolution_m);
  const double has_numbers_to_m = laser.range_max_m;
  map.read("range_max_m", laser.range_max_m, ranges::length);
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
  read_ring(map, posters::sonar_count_max, ranges::length_error, ring);
  constexpr NumberRange cone{least_nonzero, 90, "degrees above 0, at most 90"};
  map.read_degrees("half_cone_deg", ring.half_cone_rad, cone);
  map.read("range_noise_relative", ring.range_noise_relative, ranges::rate_error);
  constexpr NumberRange celsius{-60, 60, "degrees from -60 to 60"};
  map.read("air_celsius", ring.air_celsius, celsius);
  map.read("calibrated_celsius", ring.calibrated_celsius, celsius);
  map.read("crosstalk", ring.crosstalk);
  if (const YamlNode* order = map.find("firing_order")) read_firing_order(*order, ring);
  return ring;
}

world::BumperDescription read_bumpers(const YamlNode& node) {
  const YamlMap map(node, "the bumpers", {"count", "travel_m"});
  world::BumperDescription bumpers;
  map.read("count", bumpers.count, 1, posters::bumper_count_max);
  constexpr NumberRange travel{1e-5, 0.1, "a distance from 0.00001 to 0.1 m"};  // bodies stop short of contact
  map.read("travel_m", bumpers.travel_m, travel);
  return bumpers;
}

world::InfraredRingDescription read_infrareds(const YamlNode& node) {
  const YamlMap map(node, "the infrared range finders",
                    {"count", "ring_radius_m", "height_m", "range_min_m", "range_max_m", "gain_per_v", "exponent",
                     "noise_v", "resolution_v", "period_ms"});
  world::InfraredRingDescription ring;
  read_ring(map, posters::infrared_count_max, ranges::length, ring);
  map.read("gain_per_v", ring.gain_per_v, ranges::factor);
  constexpr NumberRange falling{-10, -0.1, "a number from -10 to -0.1"};
  map.read("exponent", ring.exponent, falling);
  map.read("noise_v", ring.noise_v, ranges::rate_error);
  map.read("resolution_v", ring.resolution_v, step);
  return ring;
}

world::ImuDescription read_imu(const YamlNode& node) {
  world::ImuDescription imu;
  read_object(node, "the imu", keys_of<world::ImuDescription>(), imu);
  return imu;
}

world::PositionReceiverDescription read_gps(const YamlNode& node) {
  const YamlMap map(node, "the gps",
                    {"antenna_m", "bias_x_m", "bias_y_m", "drift_m", "drift_s", "noise_m", "height_factor",
                     "resolution_m", "dropout", "period_ms"});
  world::PositionReceiverDescription gps;
  if (const YamlNode* antenna = map.find("antenna_m")) gps.antenna = read_point(*antenna, "antenna_m");
  map.read("bias_x_m", gps.bias_x_m, ranges::coordinate);
  map.read("bias_y_m", gps.bias_y_m, ranges::coordinate);
  map.read("drift_m", gps.drift_m, ranges::length_error);
  map.read("drift_s", gps.drift_s, ranges::time_constant);
  map.read("noise_m", gps.noise_m, ranges::length_error);
  map.read("height_factor", gps.height_factor, ranges::rate_error);
  map.read("resolution_m", gps.resolution_m, ranges::resolution);
  map.read("dropout", gps.dropout, probability);
  map.read("period_ms", gps.period, 1ms);
  return gps;
}

}  // namespace waitpoint::scenario
