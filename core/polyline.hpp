// SPDX-License-Identifier: BSD-3-Clause
// Lines through many points, reduced to those that give their form.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/pose.hpp"

namespace waitpoint {

/// Indices, in order, of the points that remain if those within `tolerance` of the line through the others are left
/// out (Douglas and Peucker 1973). First and last point always remain.
std::vector<std::size_t> simplified(std::span<const Point> line, double tolerance);

}  // namespace waitpoint
