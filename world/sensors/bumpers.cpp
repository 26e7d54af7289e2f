// SPDX-License-Identifier: BSD-3-Clause
#include "world/sensors/bumpers.hpp"

#include <cmath>

#include "core/error.hpp"

namespace waitpoint::world {

std::uint32_t pressed_panel(const Bumpers::Description& bumper, double heading_rad, const Separation& separation) {
  WAITPOINT_CHECK(0 < bumper.count && bumper.count <= Bumpers::count_max, "a bumper has no panel, or more than bits");
  if (separation.distance_m > bumper.travel_m) return 0;
  const double bearing = exact::atan2(separation.normal.y, separation.normal.x) - heading_rad;
  const double panels = std::nearbyint(exact::wrap_angle(bearing) * bumper.count / (2 * exact::pi));
  const auto panel = static_cast<std::int64_t>(panels) + bumper.count;
  WAITPOINT_FAST_CHECK(panel >= 0, "a panel's number is negative");
  return std::uint32_t{1} << (panel % bumper.count);
}

void Bumpers::Model::read(const Surroundings& surroundings, std::uint64_t, Reading& reading) const {
  reading.pressed = 0;
  for (const Separation& separation : surroundings.near(description_.travel_m))
    reading.pressed |= pressed_panel(description_, surroundings.body().pose.heading, separation);
}

}  // namespace waitpoint::world
