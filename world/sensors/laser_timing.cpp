// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/laser_timing.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace waitpoint::world {

double beam_time_s(const LaserDescription& laser, std::uint32_t beam) {
  WAITPOINT_CHECK(beam < laser.beams && laser.interlaced_turns > 0, "a laser has no such beam, or turns by no turn");
  if (laser.beams < 2) return 0;
  const double angle_rad = laser.field_of_view_rad * beam / (laser.beams - 1);
  const double turns = beam % laser.interlaced_turns + angle_rad / (2 * exact::pi);
  return turns * laser.mirror_turn.seconds();
}

double scan_span_s(const LaserDescription& laser) {
  double span_s = 0;
  // The last beam of each turn is among the last `interlaced_turns` beams.
  for (std::uint32_t i = 0; i < std::min(laser.interlaced_turns, laser.beams); ++i)
    span_s = std::max(span_s, beam_time_s(laser, laser.beams - 1 - i));
  return span_s;
}

std::uint32_t telegram_bytes(const LaserDescription& laser) {
  constexpr std::uint32_t frame_bytes = 10, range_bytes = 2;
  return frame_bytes + range_bytes * laser.beams;
}

Duration Lasers::transmission(const LaserDescription& laser) {
  if (laser.line_bit_s == 0) return Duration();
  constexpr std::int64_t bits_a_byte = 10, second_ns = 1'000'000'000;
  return Duration::from_ns(telegram_bytes(laser) * bits_a_byte * second_ns / laser.line_bit_s);
}

Duration least_period(const LaserDescription& laser) {
  return std::max(laser.mirror_turn * static_cast<std::int64_t>(laser.interlaced_turns), Lasers::transmission(laser));
}

}  // namespace waitpoint::world
