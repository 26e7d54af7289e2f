// SPDX-License-Identifier: BSD-3-Clause
#include "modules/scenario/sensor_reader.hpp"

#include <algorithm>

#include "world/sensors/laser_models.hpp"
#include "world/sensors/laser_timing.hpp"
#include "world/sensors/sonar.hpp"

namespace waitpoint::scenario {
namespace {

constexpr std::string_view laser_models[] = {"generic", "lms200", "lms291"};

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

Json firing_order_schema(SchemaDefinitions&) { return list_schema(count_schema({0, world::Sonars::count_max - 1}), 1); }

/// What follows of an LMS from its beams and its line, unless it is given.
void complete_lms(const YamlMap& map, world::LaserDescription& laser) {
  const double has_numbers_to_m = world::lms_range_max_m(laser.resolution_m);
  if (!map.has("range_max_m")) laser.range_max_m = has_numbers_to_m;
  if (laser.range_max_m > has_numbers_to_m) {
    throw map.require("range_max_m")
        .written.bad("expected range_max_m to be at most 8191 times resolution_m, found '" + map.text("range_max_m") +
                     "'");
  }
  if (const auto cannot = set_lms_mode(laser)) throw map.node().written.bad(*cannot);
  if (!map.has("period_ms")) laser.period = world::least_period(laser);
}

}  // namespace

template <>
const Keys<world::LaserDescription>& sensor_keys<world::Lasers>() {
  const auto text = [](SchemaDefinitions&) { return text_schema(); };
  static const Keys<world::LaserDescription> keys =
      Keys<world::LaserDescription>("lasers")
          .add("name", text, "of its device values NAME.reading and NAME.command; default laser")
          .add(
              "model", [](SchemaDefinitions&) { return word_schema(laser_models); }, "whose figures are the defaults")
          .add("frame", text, "link of the urdf that it is mounted at, in the place of mount and height_m")
          .add_fields();
  return keys;
}

template <>
const Keys<world::SonarRingDescription>& sensor_keys<world::Sonars>() {
  static const Keys<world::SonarRingDescription> keys = Keys<world::SonarRingDescription>("sonars").add_fields().add(
      "firing_order", read_firing_order, firing_order_schema,
      "`[0, 2, 1, 3]`: banks of four neighbours fire in this order, one of each bank at once; without it all");
  return keys;
}

LaserReading read_laser(const YamlNode& node) {
  const Keys<world::LaserDescription>& keys = sensor_keys<world::Lasers>();
  const YamlMap map(node, std::string(world::Lasers::noun), keys.table().names());
  const std::size_t model = map.one_of("model", {laser_models[0], laser_models[1], laser_models[2]}, 0);
  LaserReading reading;
  world::LaserDescription& laser = reading.laser;
  if (model != 0) laser = model == 1 ? world::lms_200() : world::lms_291();
  reading.name = map.text("name", "laser");
  keys.read(map, laser);
  if (model != 0) complete_lms(map, laser);
  if (const Duration least = world::least_period(laser); laser.period < least) {
    throw map.node().written.bad("expected period_ms to be at least " + to_string(least * 1000) +
                                 ": the time of a scan at the mirror or on the line");
  }
  return reading;
}

}  // namespace waitpoint::scenario
