// SPDX-License-Identifier: BSD-3-Clause
// Symmetric 3 x 3 matrices of (x, y, heading), in row order: covariances and information.
#pragma once

#include <array>

#include "core/exact_math.hpp"

namespace waitpoint::matching {

using Matrix3 = std::array<double, 9>;

/// The inverse of a symmetric positive matrix; zero if it is not positive.
inline Matrix3 inverse(const Matrix3& m) {
  const double c0 = m[4] * m[8] - m[5] * m[5], c1 = m[2] * m[5] - m[1] * m[8], c2 = m[1] * m[5] - m[2] * m[4];
  const double determinant = m[0] * c0 + m[1] * c1 + m[2] * c2;
  if (!(determinant > 0)) return {};
  const double k = 1 / determinant;
  const double c11 = m[0] * m[8] - m[2] * m[2], c12 = m[1] * m[2] - m[0] * m[5], c22 = m[0] * m[4] - m[1] * m[1];
  return {k * c0, k * c1, k * c2, k * c1, k * c11, k * c12, k * c2, k * c12, k * c22};
}

/// The matrix of a frame turned by an angle: R m R'.
inline Matrix3 turned(const Matrix3& m, double angle) {
  const auto [s, c] = exact::sincos(angle);
  const double xx = c * c * m[0] - 2 * c * s * m[1] + s * s * m[4];
  const double yy = s * s * m[0] + 2 * c * s * m[1] + c * c * m[4];
  const double xy = c * s * (m[0] - m[4]) + (c * c - s * s) * m[1];
  const double xt = c * m[2] - s * m[5], yt = s * m[2] + c * m[5];
  return {xx, xy, xt, xy, yy, yt, xt, yt, m[8]};
}

/// Of (x, y, heading), with one value for x and y.
inline Matrix3 diagonal(double xy, double heading) { return {xy, 0, 0, 0, xy, 0, 0, 0, heading}; }

}  // namespace waitpoint::matching
