// SPDX-License-Identifier: BSD-3-Clause
// Points by distance and degrees, and the diagram of them.
#pragma once

#include <vector>

#include "modules/ndd/diagram.hpp"

namespace waitpoint::ndd {

inline constexpr double degree = exact::pi / 180;

inline Point polar(double distance, double degrees) {
  const auto [s, c] = exact::sincos(degrees * degree);
  return {distance * c, distance * s};
}

inline Diagram diagram_of(const std::vector<Point>& points) {
  Diagram diagram;
  diagram.build(points, 8);
  return diagram;
}

}  // namespace waitpoint::ndd
