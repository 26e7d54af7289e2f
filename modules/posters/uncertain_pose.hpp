// SPDX-License-Identifier: BSD-3-Clause
// Poses with covariances: composition, increments, and the Kalman update. Covariances are of (x, y, heading), in row
// order, kept symmetric.
//
// For c = compose(a, b):   C = A Ca A' + B Cb B'
//
//       [ 1  0  -(yc - ya) ]        [ cos a  -sin a  0 ]
//   A = [ 0  1    xc - xa  ]    B = [ sin a   cos a  0 ]      (Smith, Self, Cheeseman 1990)
//       [ 0  0      1      ]        [   0       0    1 ]
#pragma once

#include <array>

#include "core/pose.hpp"

namespace waitpoint::posters {

using Matrix3 = std::array<double, 9>;  ///< row by row

Matrix3 operator*(const Matrix3& a, const Matrix3& b);
Matrix3 operator+(const Matrix3& a, const Matrix3& b);
Matrix3 operator-(const Matrix3& a, const Matrix3& b);
Matrix3 operator*(double k, const Matrix3& a);
Matrix3 transpose(const Matrix3& a);
/// A C A'.
Matrix3 congruent(const Matrix3& a, const Matrix3& c);
/// The mean of a matrix and its transpose.
Matrix3 symmetric(const Matrix3& a);
/// Inverts a symmetric positive definite matrix; false if the determinant is 0 or less.
bool invert(const Matrix3& a, Matrix3& inverse);

struct UncertainPose {
  Pose pose;
  Matrix3 covariance{};
};

/// b, given in the frame of a and independent of a, in the frame of a's parent.
UncertainPose compose(const UncertainPose& a, const UncertainPose& b);

/// The b with compose(a, b) = c, where c results from a by a motion independent of a: dead reckoning at two dates. The
/// covariance is that of the motion, in the frame of a.
UncertainPose increment(const UncertainPose& a, const UncertainPose& c);

/// The part of an increment after `fraction` of its time, at constant speeds.
UncertainPose part_of(const UncertainPose& increment, double fraction);

/// Squared Mahalanobis distance of two independent estimates of one pose (3 degrees of freedom). Infinite if neither
/// has any uncertainty.
double disagreement(const UncertainPose& a, const UncertainPose& b);

/// Kalman fusion of two independent estimates of one pose. Returns `prior` if neither has any uncertainty.
UncertainPose fuse(const UncertainPose& prior, const UncertainPose& measured);

/// Fusion of two estimates that may share part of their errors, such as positions based on the same odometry:
/// covariance intersection with equal weights (Julier, Uhlmann 1997). Never overconfident, even if repeated.
UncertainPose fuse_correlated(const UncertainPose& prior, const UncertainPose& measured);

/// The standard deviation along the longest axis of the position's error ellipse.
double greatest_deviation_m(const Matrix3& covariance);

}  // namespace waitpoint::posters
