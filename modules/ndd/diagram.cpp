// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/diagram.hpp"

#include <array>
#include <cmath>

#include "core/exact_batch.hpp"

namespace waitpoint::ndd {

void Diagram::build(std::span<const Point> points, double range_m) {
  sectors_.fill(Sector{});
  std::array<double, exact::batch> x, y, square, angle;
  std::size_t near = 0;
  const auto enter = [&] {
    exact::atan2(std::span(y).first(near), std::span(x).first(near), angle);
    for (std::size_t i = 0; i < near; ++i) {
      Sector& sector = sectors_[static_cast<std::size_t>(sector_at(angle[i]))];
      const double distance = std::sqrt(square[i]);
      if (distance < sector.distance_m) sector = {distance, angle[i], {x[i], y[i]}};
    }
    near = 0;
  };
  for (const Point p : points) {
    square[near] = dot(p, p);
    if (square[near] >= range_m * range_m) continue;
    x[near] = p.x;
    y[near] = p.y;
    if (++near == exact::batch) enter();
  }
  enter();
}

int Diagram::sector_at(double angle_rad) {
  // Rounded as by nearbyint(), a call for each point of each scan on processors of the baseline.
  const double from_middle = (angle_rad / sector_width_rad + 0x1.8p52) - 0x1.8p52;
  return static_cast<int>(wrap(static_cast<int>(from_middle) + sector_count / 2));
}

double Diagram::bisector_rad(int sector) {
  const int from_middle = static_cast<int>(wrap(sector)) - sector_count / 2;
  return static_cast<double>(from_middle) * sector_width_rad;
}

}  // namespace waitpoint::ndd
