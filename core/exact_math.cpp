// SPDX-License-Identifier: BSD-3-Clause
//
// Every function is an argument reduction that is exact or carries its rounding error along, then a Taylor series that
// is short because the reduced argument is small. Constants are split into a leading part with trailing zero bits (so
// that a product with a small integer is exact) and the rest.
#include "core/exact_math.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "core/digest.hpp"
#include "core/error.hpp"
#include "core/exact_kernels.hpp"

namespace waitpoint::exact {
namespace {

// 2^n for n in the range of normal numbers.
double power_of_two(int n) { return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52); }

}  // namespace

SinCos sincos(double x) {
  if (x != x) return {x, x};
  if (x == 0.0) return {x, 1.0};  // the sign of a zero would be lost
  WAITPOINT_CHECK(std::fabs(x) <= 1e6, "an angle beyond 1e6 rad");
  SinCos result;
  sincos_kernel(x, result.sin, result.cos);
  return result;
}

double sin(double x) { return sincos(x).sin; }
double cos(double x) { return sincos(x).cos; }

double atan2(double y, double x) {
  if (x != x || y != y) return std::numeric_limits<double>::quiet_NaN();
  double ax = std::fabs(x), ay = std::fabs(y);
  constexpr double inf = std::numeric_limits<double>::infinity();
  if (ax == inf && ay == inf) {
    ax = ay = 1.0;
  } else if (ax == inf || ay == inf) {
    ax = ax == inf ? 1.0 : 0.0;
    ay = ay == inf ? 1.0 : 0.0;
  }
  // The ratio's products must neither overflow nor fall among the subnormal numbers.
  const double larger = ax > ay ? ax : ay;
  const double scale = larger > 0x1p1000 ? 0x1p-100 : larger < 0x1p-900 ? 0x1p100 : 1.0;
  ax *= scale;
  ay *= scale;
  if (ay == 0.0) return std::copysign(std::signbit(x) ? whole_pi.high : 0.0, y);
  double angle;
  atan2_kernel(std::copysign(ay, y), std::copysign(ax, x), angle);
  return angle;
}

double exp(double x) {
  if (x != x) return x;
  if (x > 709.782712893384) return std::numeric_limits<double>::infinity();
  if (x < -745.2) return 0.0;
  const double n = std::nearbyint(x * 1.4426950408889634);
  const double high = x - n * ln2_high;
  const double low = n * ln2_low;
  const double r = high - low;
  const double lost = (high - r) - low;
  double t = 1.0 / 6227020800.0;  // 1/13!
  t = t * r + 1.0 / 479001600.0;
  t = t * r + 1.0 / 39916800.0;
  t = t * r + 1.0 / 3628800.0;
  t = t * r + 1.0 / 362880.0;
  t = t * r + 1.0 / 40320.0;
  t = t * r + 1.0 / 5040.0;
  t = t * r + 1.0 / 720.0;
  t = t * r + 1.0 / 120.0;
  t = t * r + 1.0 / 24.0;
  t = t * r + 1.0 / 6.0;
  t = t * r + 0.5;
  const double result = 1.0 + (r + (t * r * r + lost));
  const int k = static_cast<int>(n);
  // In two steps, so that subnormal results and those near the greatest number are reached without leaving the range.
  const int half = k / 2;
  return result * power_of_two(half) * power_of_two(k - half);
}

double log(double x) {
  if (x != x || x < 0.0) return std::numeric_limits<double>::quiet_NaN();
  if (x == 0.0) return -std::numeric_limits<double>::infinity();
  if (x == std::numeric_limits<double>::infinity()) return x;
  const bool subnormal = x < std::numeric_limits<double>::min();
  double result;
  log_kernel(subnormal ? x * 0x1p54 : x, subnormal ? -54 : 0, result);
  return result;
}

double hypot(double x, double y) { return std::sqrt(x * x + y * y); }

double wrap_angle(double x) {
  if (x > -pi && x <= pi) return x;
  double wrapped = std::fmod(x, 2.0 * pi);  // exact
  if (wrapped > pi) wrapped -= 2.0 * pi;
  if (wrapped <= -pi) wrapped += 2.0 * pi;
  return wrapped;
}

std::uint64_t fingerprint() {
  Digest digest;
  for (int i = 0; i < 2000; ++i) {
    const double x = (i - 1000) * 0.7390851332151607;
    const auto [s, c] = sincos(x);
    digest.add(s);
    digest.add(c);
    digest.add(atan2(s, x));
    digest.add(exp(x * 0.5));
    digest.add(log(x * x + 1e-3));
    digest.add(hypot(x, s));
  }
  return digest.value();
}

}  // namespace waitpoint::exact
