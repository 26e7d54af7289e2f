// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/diagram.hpp"

#include <cmath>

namespace waitpoint::ndd {

void Diagram::build(std::span<const Point> points, double range_m) {
  sectors_.fill(Sector{});
  for (const Point p : points) {
    const double square = dot(p, p);
    if (square >= range_m * range_m) continue;
    const double angle = exact::atan2(p.y, p.x);
    Sector& sector = sectors_[wrap(sector_at(angle))];
    const double distance = std::sqrt(square);
    if (distance < sector.distance_m) sector = {distance, angle, p};
  }
}

int Diagram::sector_at(double angle_rad) {
  return static_cast<int>(wrap(static_cast<int>(std::nearbyint(angle_rad / sector_width_rad)) + sector_count / 2));
}

double Diagram::bisector_rad(int sector) {
  const int from_middle = static_cast<int>(wrap(sector)) - sector_count / 2;
  return static_cast<double>(from_middle) * sector_width_rad;
}

}  // namespace waitpoint::ndd
