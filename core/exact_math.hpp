// SPDX-License-Identifier: BSD-3-Clause
// Elementary functions with the same bits on every CPU, compiler and C library.
//
// The C library's differ in the last bit between CPUs with and without fused multiply-add and between releases; ours
// use only +, -, *, / and sqrt of IEEE 754 double, in a written order, with contraction off. Bounds on the error, in
// units in the last place of the result, measured against long double by the tests: sin, cos, atan2, exp, log 2 ulp.
//
// Special values follow the C standard (Annex F) where they arise: NaN in, NaN out; log(0) = -inf; exp overflows to
// inf. sin and cos reduce arguments up to 1e6 in magnitude; beyond, they are a bug (a heading is never that large).
#pragma once

#include <cstdint>

namespace waitpoint::exact {

inline constexpr double pi = 3.14159265358979323846;

struct SinCos {
  double sin, cos;
};

/// Sine and cosine of an angle in radians, |x| <= 1e6.
SinCos sincos(double x);
double sin(double x);
double cos(double x);
/// Angle of the point (x, y), in [-pi, pi].
double atan2(double y, double x);
double exp(double x);
/// Natural logarithm.
double log(double x);
/// sqrt(x^2 + y^2), without protection against overflow: lengths in metres.
double hypot(double x, double y);
/// The equivalent angle in (-pi, pi].
double wrap_angle(double x);

constexpr double square(double x) { return x * x; }

/// A hash of some thousand results of the functions above: equal on all machines on which the results are.
std::uint64_t fingerprint();

}  // namespace waitpoint::exact
