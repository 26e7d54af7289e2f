// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/world/grounds.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace waitpoint::bench {
namespace {

constexpr double clear_m = 0.3;

world::Shape obstacle(const RandomStream& draw, std::size_t number, Point corner, double square_m) {
  world::Shape shape;
  const double free_m = square_m - 2 * clear_m, size_m = 0.4 * free_m;
  const auto uniform = [&](std::uint64_t index) { return draw.uniform(number, index); };
  shape.pose = {corner.x + clear_m + free_m * (0.25 + 0.5 * uniform(0)),
                corner.y + clear_m + free_m * (0.25 + 0.5 * uniform(1)), uniform(2) < 0.5 ? 0 : 3 * uniform(2)};
  shape.length_m = size_m * (0.2 + 0.6 * uniform(3));
  shape.width_m = size_m * (0.2 + 0.6 * uniform(4));
  if (uniform(5) < 0.3) {
    shape.kind = world::Shape::Kind::cylinder;
    shape.radius_m = 0.5 * shape.width_m;
  }
  return shape;
}

}  // namespace

Place grounds(std::size_t obstacles, double square_m, std::size_t stations, double border_m) {
  const auto columns = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(obstacles))));
  const double side_m = static_cast<double>(columns) * square_m;
  Place place{"grounds", side_m, side_m, {}, {}, {}};
  const RandomStream draw(1, place.name, "obstacles"), headings(1, place.name, "headings");
  const auto corner = [&](std::size_t square) {
    return square_m * Point{static_cast<double>(square % columns), static_cast<double>(square / columns)};
  };
  for (std::size_t i = 0; i < obstacles; ++i) place.obstacles.push_back(obstacle(draw, i, corner(i), square_m));
  const auto outer = static_cast<std::size_t>(std::ceil(border_m / square_m)), inner = columns - 2 * outer;
  const RandomStream squares(1, place.name, "stations");
  for (std::size_t i = 0; i < stations; ++i) {
    const auto drawn = [&](std::uint64_t index) { return outer + squares.below(inner, i, index); };
    const Point at = border_m > 0 ? corner(drawn(0) + columns * drawn(1)) : corner(i * obstacles / stations);
    place.stations.push_back({at.x, at.y, exact::pi * (2 * headings.uniform(i) - 1)});
  }
  return place;
}

}  // namespace waitpoint::bench
