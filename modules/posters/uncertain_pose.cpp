// SPDX-License-Identifier: BSD-3-Clause
#include "modules/posters/uncertain_pose.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace waitpoint::posters {
namespace {

constexpr Matrix3 identity = {1, 0, 0, 0, 1, 0, 0, 0, 1};

Matrix3 moved_frame(const Pose& a, const Pose& c) { return {1, 0, a.y - c.y, 0, 1, c.x - a.x, 0, 0, 1}; }

Matrix3 turned_frame(double heading) {
  const auto [s, c] = exact::sincos(heading);
  return {c, -s, 0, s, c, 0, 0, 0, 1};
}

std::array<double, 3> difference(const Pose& from, const Pose& to) {
  return {to.x - from.x, to.y - from.y, exact::wrap_angle(to.heading - from.heading)};
}

std::array<double, 3> transformed(const Matrix3& m, const std::array<double, 3>& v) {
  std::array<double, 3> r{};
  for (std::size_t i = 0; i < 3; ++i) r[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
  return r;
}

}  // namespace

Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
  Matrix3 r{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      r[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
    }
  }
  return r;
}

Matrix3 operator+(const Matrix3& a, const Matrix3& b) {
  Matrix3 r{};
  for (std::size_t i = 0; i < 9; ++i) r[i] = a[i] + b[i];
  return r;
}

Matrix3 operator-(const Matrix3& a, const Matrix3& b) {
  Matrix3 r{};
  for (std::size_t i = 0; i < 9; ++i) r[i] = a[i] - b[i];
  return r;
}

Matrix3 operator*(double k, const Matrix3& a) {
  Matrix3 r{};
  for (std::size_t i = 0; i < 9; ++i) r[i] = k * a[i];
  return r;
}

Matrix3 transpose(const Matrix3& a) { return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]}; }

Matrix3 symmetric(const Matrix3& a) { return 0.5 * (a + transpose(a)); }

Matrix3 congruent(const Matrix3& a, const Matrix3& c) { return symmetric(a * c * transpose(a)); }

bool invert(const Matrix3& a, Matrix3& inverse) {
  const double c0 = a[4] * a[8] - a[5] * a[7], c1 = a[5] * a[6] - a[3] * a[8], c2 = a[3] * a[7] - a[4] * a[6];
  const double determinant = a[0] * c0 + a[1] * c1 + a[2] * c2;
  if (!(determinant > 0)) return false;
  const Matrix3 adjugate = {c0, a[2] * a[7] - a[1] * a[8], a[1] * a[5] - a[2] * a[4],
                            c1, a[0] * a[8] - a[2] * a[6], a[2] * a[3] - a[0] * a[5],
                            c2, a[1] * a[6] - a[0] * a[7], a[0] * a[4] - a[1] * a[3]};
  inverse = symmetric((1 / determinant) * adjugate);
  return true;
}

UncertainPose compose(const UncertainPose& a, const UncertainPose& b) {
  const Pose c = waitpoint::compose(a.pose, b.pose);
  return {c, congruent(moved_frame(a.pose, c), a.covariance) + congruent(turned_frame(a.pose.heading), b.covariance)};
}

UncertainPose increment(const UncertainPose& a, const UncertainPose& c) {
  const Matrix3 gained = c.covariance - congruent(moved_frame(a.pose, c.pose), a.covariance);
  Matrix3 own = congruent(turned_frame(-a.pose.heading), gained);
  // The difference of two large numbers may be slightly below 0 for a small motion.
  for (const std::size_t i : {0u, 4u, 8u}) own[i] = std::max(own[i], 0.0);
  return {between(a.pose, c.pose), own};
}

UncertainPose part_of(const UncertainPose& increment, double fraction) {
  return {interpolate({}, increment.pose, fraction), fraction * increment.covariance};
}

double disagreement(const UncertainPose& a, const UncertainPose& b) {
  Matrix3 inverse{};
  if (!invert(a.covariance + b.covariance, inverse)) return std::numeric_limits<double>::infinity();
  const std::array<double, 3> d = difference(a.pose, b.pose);
  const std::array<double, 3> weighted = transformed(inverse, d);
  return d[0] * weighted[0] + d[1] * weighted[1] + d[2] * weighted[2];
}

UncertainPose fuse(const UncertainPose& prior, const UncertainPose& measured) {
  Matrix3 inverse{};
  if (!invert(prior.covariance + measured.covariance, inverse)) return prior;
  const Matrix3 gain = prior.covariance * inverse;
  const std::array<double, 3> shift = transformed(gain, difference(prior.pose, measured.pose));
  // Joseph's form: stays positive despite rounding.
  const Matrix3 kept = identity - gain;
  return {{prior.pose.x + shift[0], prior.pose.y + shift[1], exact::wrap_angle(prior.pose.heading + shift[2])},
          congruent(kept, prior.covariance) + congruent(gain, measured.covariance)};
}

UncertainPose fuse_correlated(const UncertainPose& prior, const UncertainPose& measured) {
  return fuse({prior.pose, 2.0 * prior.covariance}, {measured.pose, 2.0 * measured.covariance});
}

double greatest_deviation_m(const Matrix3& c) {
  const double mean = 0.5 * (c[0] + c[4]), half = 0.5 * (c[0] - c[4]);
  return std::sqrt(std::max(0.0, mean + std::sqrt(half * half + c[1] * c[1])));
}

}  // namespace waitpoint::posters
