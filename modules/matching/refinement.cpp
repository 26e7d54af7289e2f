// SPDX-License-Identifier: BSD-3-Clause
#include "modules/matching/refinement.hpp"

#include <cmath>

namespace waitpoint::matching {
namespace {

/// Normal equations of the three variables, and the counts of their computation.
struct Sums {
  std::array<double, 6> a{};  // (0,0) (0,1) (0,2) (1,1) (1,2) (2,2)
  std::array<double, 3> b{};
  double squares = 0, fit = 0;
  unsigned explained = 0, pairs = 0;
};

Sums gather(const SurfaceMap& map, std::span<const SurfacePoint> scan, const Pose& pose,
            const RefinementParameters& parameters) {
  Sums sums;
  const auto [sine, cosine] = exact::sincos(pose.heading);
  const double per_variance = 1 / (parameters.noise_m * parameters.noise_m);
  const double per_robust = 1 / (parameters.robust_m * parameters.robust_m);
  for (const SurfacePoint& point : scan) {
    const Point arm{cosine * point.position.x - sine * point.position.y,
                    sine * point.position.x + cosine * point.position.y};
    const Point at{pose.x + arm.x, pose.y + arm.y};
    const Point own{cosine * point.normal.x - sine * point.normal.y, sine * point.normal.x + cosine * point.normal.y};
    const SurfacePoint* near = map.nearest(at, own);
    if (near == nullptr) continue;
    const bool has_own = own.x != 0 || own.y != 0, has_line = near->normal.x != 0 || near->normal.y != 0;
    if (has_own && has_line && dot(own, near->normal) < parameters.same_side_cos) continue;
    const Point gap = at - near->position;
    if (!has_own && !has_line) {
      if (dot(gap, gap) < parameters.explained_m * parameters.explained_m) ++sums.explained;
      continue;
    }
    const Point normal = has_line ? near->normal : own;
    const double distance = dot(normal, gap);
    if (std::fabs(distance) < parameters.explained_m) {
      ++sums.explained;
      ++sums.pairs;
      sums.squares += distance * distance;
    }
    const double falling = 1 / (1 + distance * distance * per_robust);
    sums.fit += falling;
    const double weight = per_variance * falling * falling;
    const double turning = normal.y * arm.x - normal.x * arm.y;
    sums.a[0] += weight * normal.x * normal.x;
    sums.a[1] += weight * normal.x * normal.y;
    sums.a[2] += weight * normal.x * turning;
    sums.a[3] += weight * normal.y * normal.y;
    sums.a[4] += weight * normal.y * turning;
    sums.a[5] += weight * turning * turning;
    sums.b[0] -= weight * normal.x * distance;
    sums.b[1] -= weight * normal.y * distance;
    sums.b[2] -= weight * turning * distance;
  }
  return sums;
}

/// Solves by Cramer's rule; false if the matrix is not positive.
bool solve(const std::array<double, 6>& a, const std::array<double, 3>& b, std::array<double, 3>& x) {
  const double c0 = a[3] * a[5] - a[4] * a[4], c1 = a[2] * a[4] - a[1] * a[5], c2 = a[1] * a[4] - a[2] * a[3];
  const double determinant = a[0] * c0 + a[1] * c1 + a[2] * c2;
  if (!(determinant > 0)) return false;
  const double c11 = a[0] * a[5] - a[2] * a[2], c12 = a[1] * a[2] - a[0] * a[4], c22 = a[0] * a[3] - a[1] * a[1];
  x = {(c0 * b[0] + c1 * b[1] + c2 * b[2]) / determinant, (c1 * b[0] + c11 * b[1] + c12 * b[2]) / determinant,
       (c2 * b[0] + c12 * b[1] + c22 * b[2]) / determinant};
  return true;
}

}  // namespace

Refined refine(const SurfaceMap& map, std::span<const SurfacePoint> scan, const Pose& guess, const Matrix3& prior,
               const RefinementParameters& parameters) {
  Refined refined;
  refined.pose = guess;
  for (unsigned i = 0;; ++i) {
    const Sums sums = gather(map, scan, refined.pose, parameters);
    const auto& a = sums.a;
    refined.information = {a[0], a[1], a[2], a[1], a[3], a[4], a[2], a[4], a[5]};
    refined.explained = scan.empty() ? 0 : static_cast<double>(sums.explained) / static_cast<double>(scan.size());
    refined.fit = scan.empty() ? 0 : sums.fit / static_cast<double>(scan.size());
    refined.pairs = sums.pairs;
    refined.deviation_m = sums.pairs > 0 ? std::sqrt(sums.squares / sums.pairs) : 0;
    if (i == parameters.iterations) break;
    const std::array<double, 3> away = {refined.pose.x - guess.x, refined.pose.y - guess.y,
                                        exact::wrap_angle(refined.pose.heading - guess.heading)};
    std::array<double, 3> b = sums.b;
    for (std::size_t k = 0; k < 3; ++k) {
      b[k] -= prior[3 * k] * away[0] + prior[3 * k + 1] * away[1] + prior[3 * k + 2] * away[2];
    }
    const std::array<double, 6> whole = {a[0] + prior[0], a[1] + prior[1], a[2] + prior[2],
                                         a[3] + prior[4], a[4] + prior[5], a[5] + prior[8]};
    std::array<double, 3> step{};
    if (!solve(whole, b, step)) break;
    refined.pose = {refined.pose.x + step[0], refined.pose.y + step[1],
                    exact::wrap_angle(refined.pose.heading + step[2])};
    if (i + 1 < parameters.iterations && std::fabs(step[0]) < 2e-4 && std::fabs(step[1]) < 2e-4 &&
        std::fabs(step[2]) < 5e-5) {
      i = parameters.iterations - 1;  // converged: once more for the figures at the pose
    }
  }
  return refined;
}

}  // namespace waitpoint::matching
