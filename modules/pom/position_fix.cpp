// SPDX-License-Identifier: BSD-3-Clause
#include "modules/pom/position_fix.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace waitpoint::pom {

using posters::congruent;
using posters::greatest_deviation_m;
using posters::Matrix3;
using posters::operator+;  // NOLINT(misc-unused-using-decls): clang-tidy 14 sees no uses of operators
namespace {

/// The difference between a fix and the antenna of a pose: h = p + R(heading) a,
///
///       [ 1  0  -ay' ]
///   H = [ 0  1   ax' ]    with a' = R(heading) a      S = H P H' + R
struct Innovation {
  double missing[2];
  double row[2][3];     // H
  double across[3][2];  // P H'
  double own[3];        // H P H': xx, xy, yy
  Point turned;         // a'
};

Innovation innovation(const UncertainPose& pose, const PositionFix& fix) {
  const auto [s, c] = exact::sincos(pose.pose.heading);
  const Point turned = {c * fix.antenna.x - s * fix.antenna.y, s * fix.antenna.x + c * fix.antenna.y};
  Innovation i = {{fix.position.x - pose.pose.x - turned.x, fix.position.y - pose.pose.y - turned.y},
                  {{1, 0, -turned.y}, {0, 1, turned.x}},
                  {},
                  {},
                  turned};
  const Matrix3& p = pose.covariance;
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t m = 0; m < 2; ++m)
      i.across[k][m] = p[3 * k] * i.row[m][0] + p[3 * k + 1] * i.row[m][1] + p[3 * k + 2] * i.row[m][2];
  const auto product = [&](std::size_t m, std::size_t n) {
    return i.row[m][0] * i.across[0][n] + i.row[m][1] * i.across[1][n] + i.row[m][2] * i.across[2][n];
  };
  i.own[0] = product(0, 0), i.own[1] = product(0, 1), i.own[2] = product(1, 1);
  return i;
}

/// The inverse of S, as own; false if it has none.
bool invert(const Innovation& i, double variance_m2, double (&inverse)[3]) {
  const double xx = i.own[0] + variance_m2, xy = i.own[1], yy = i.own[2] + variance_m2;
  const double determinant = xx * yy - xy * xy;
  if (!(determinant > 0)) return false;
  inverse[0] = yy / determinant, inverse[1] = -xy / determinant, inverse[2] = xx / determinant;
  return true;
}

}  // namespace

PositionFix fix_at(Point position, const FixParameters& p) {
  return {
      position, {p.gps_antenna_x_m, p.gps_antenna_y_m}, p.gps_noise_m * p.gps_noise_m, p.gps_drift_m * p.gps_drift_m};
}

double disagreement(const UncertainPose& predicted, const PositionFix& fix) {
  const Innovation i = innovation(predicted, fix);
  double inverse[3];
  if (!invert(i, fix.variance_m2(), inverse)) return std::numeric_limits<double>::infinity();
  const double x = i.missing[0], y = i.missing[1];
  return inverse[0] * x * x + 2 * inverse[1] * x * y + inverse[2] * y * y;
}

UncertainPose fuse(const UncertainPose& prior, const PositionFix& fix) {
  if (greatest_deviation_m(prior.covariance) <= std::sqrt(fix.common_m2)) return prior;
  const Innovation i = innovation(prior, fix);
  double inverse[3];
  if (!invert(i, fix.variance_m2(), inverse)) return prior;
  double gain[3][2], shift[3];
  Matrix3 kept{}, added{};
  for (std::size_t k = 0; k < 3; ++k) {
    gain[k][0] = i.across[k][0] * inverse[0] + i.across[k][1] * inverse[1];
    gain[k][1] = i.across[k][0] * inverse[1] + i.across[k][1] * inverse[2];
    shift[k] = gain[k][0] * i.missing[0] + gain[k][1] * i.missing[1];
  }
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t m = 0; m < 3; ++m) {
      kept[3 * k + m] = (k == m ? 1 : 0) - (gain[k][0] * i.row[0][m] + gain[k][1] * i.row[1][m]);
      added[3 * k + m] = fix.variance_m2() * (gain[k][0] * gain[m][0] + gain[k][1] * gain[m][1]);
    }
  }
  // Joseph's form: stays positive whatever the rounding.
  Matrix3 covariance = congruent(kept, prior.covariance) + added;
  for (const std::size_t k : {0u, 4u})
    covariance[k] = std::max(covariance[k], std::min(prior.covariance[k], fix.common_m2));
  return {{prior.pose.x + shift[0], prior.pose.y + shift[1], exact::wrap_angle(prior.pose.heading + shift[2])},
          covariance};
}

UncertainPose moved_to(const UncertainPose& prior, const PositionFix& fix) {
  const Innovation i = innovation(prior, fix);
  const double heading = prior.covariance[8], x = -i.turned.y, y = i.turned.x;  // from the third column of H
  UncertainPose moved = prior;
  moved.pose.x = fix.position.x - i.turned.x;
  moved.pose.y = fix.position.y - i.turned.y;
  moved.covariance = {fix.variance_m2() + heading * x * x,
                      heading * x * y,
                      -heading * x,
                      heading * x * y,
                      fix.variance_m2() + heading * y * y,
                      -heading * y,
                      -heading * x,
                      -heading * y,
                      heading};
  return moved;
}

}  // namespace waitpoint::pom
