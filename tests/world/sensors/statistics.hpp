// SPDX-License-Identifier: BSD-3-Clause
// Mean and standard deviation of a sensor's readings.
#pragma once

#include <cmath>
#include <vector>

#include "core/exact_math.hpp"

namespace waitpoint::world {

struct Statistics {
  double mean = 0, deviation = 0;
};

inline Statistics statistics_of(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / count)};
}

inline double radians_of_degrees(double degrees) { return degrees * (exact::pi / 180); }

}  // namespace waitpoint::world
