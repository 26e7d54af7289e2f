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

namespace waitpoint::exact {
namespace {

struct Reduced {
  double value, tail;  // the angle minus quadrant * pi/2, as an unevaluated sum
  unsigned quadrant;
};

Reduced reduce_to_quadrant(double x) {
  // pi/2 in parts of 33, 33 and 53 bits; the quadrant number has at most 20 bits.
  constexpr double first = 0x1.921fb54400000p+0, second = 0x1.0b4611a600000p-34, third = 0x1.3198a2e037073p-69;
  WAITPOINT_CHECK(std::fabs(x) <= 1e6, "an angle beyond 1e6 rad");
  const double n = std::nearbyint(x * (2.0 / pi));
  const double r = x - n * first;
  const double w = n * second;
  const double sum = r - w;
  const double undone = sum + w;
  const double error = (r - undone) - ((sum - (undone - w)));
  const double tail = error - n * third;
  const double value = sum + tail;
  return {value, (sum - value) + tail, static_cast<unsigned>(static_cast<std::int64_t>(n) & 3)};
}

SinCos kernel_sincos(double y, double tail) {
  const double z = y * y;
  double s = 1.0 / 355687428096000.0;  // 1/17!
  s = s * z - 1.0 / 1307674368000.0;
  s = s * z + 1.0 / 6227020800.0;
  s = s * z - 1.0 / 39916800.0;
  s = s * z + 1.0 / 362880.0;
  s = s * z - 1.0 / 5040.0;
  s = s * z + 1.0 / 120.0;
  s = s * z - 1.0 / 6.0;
  double c = 1.0 / 20922789888000.0;  // 1/16!
  c = c * z - 1.0 / 87178291200.0;
  c = c * z + 1.0 / 479001600.0;
  c = c * z - 1.0 / 3628800.0;
  c = c * z + 1.0 / 40320.0;
  c = c * z - 1.0 / 720.0;
  c = c * z + 1.0 / 24.0;
  const double half = 0.5 * z;
  const double w = 1.0 - half;
  return {y + (y * z * s + tail * w), w + (((1.0 - w) - half) + (z * z * c - y * tail))};
}

struct Split {
  double high, low;
};

constexpr Split arctangent_of_sixteenths[17] = {
    {0x0.0p+0, 0x0.0p+0},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};
constexpr Split half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Split whole_pi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// Arctangent of small / large, both positive and finite, small <= large.
Split arctangent_of_ratio(double small, double large) {
  const int sixteenth = static_cast<int>(std::nearbyint(small / large * 16.0));
  const double c = sixteenth / 16.0;
  const double z = (small - c * large) / (large + c * small);  // |z| <= 1/32
  const double z2 = z * z;
  double series = -1.0 / 11.0;
  series = series * z2 + 1.0 / 9.0;
  series = series * z2 - 1.0 / 7.0;
  series = series * z2 + 1.0 / 5.0;
  series = series * z2 - 1.0 / 3.0;
  const Split table = arctangent_of_sixteenths[sixteenth];
  const double rest = z + (z * z2 * series + table.low);
  const double high = table.high + rest;
  return {high, (table.high - high) + rest};
}

constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33;

// 2^n for n in the range of normal numbers.
double power_of_two(int n) { return std::bit_cast<double>(static_cast<std::uint64_t>(n + 1023) << 52); }

}  // namespace

SinCos sincos(double x) {
  if (x != x) return {x, x};
  if (x == 0.0) return {x, 1.0};  // the sign of a zero would be lost
  const Reduced r = reduce_to_quadrant(x);
  const SinCos k = kernel_sincos(r.value, r.tail);
  switch (r.quadrant) {
    case 0: return {k.sin, k.cos};
    case 1: return {k.cos, -k.sin};
    case 2: return {-k.sin, -k.cos};
    default: return {-k.cos, k.sin};
  }
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
  double angle;
  if (ay == 0.0) {
    angle = std::signbit(x) ? whole_pi.high : 0.0;
  } else if (ay <= ax) {
    const Split a = arctangent_of_ratio(ay, ax);
    angle = std::signbit(x) ? whole_pi.high - (a.high - (whole_pi.low - a.low)) : a.high + a.low;
  } else {
    const Split a = arctangent_of_ratio(ax, ay);
    angle = std::signbit(x) ? half_pi.high + (a.high + (half_pi.low + a.low))
                            : half_pi.high - (a.high - (half_pi.low - a.low));
  }
  return std::signbit(y) ? -angle : angle;
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
  int exponent = 0;
  if (x < std::numeric_limits<double>::min()) {
    x *= 0x1p54;
    exponent = -54;
  }
  std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
  exponent += static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFFu) | 0x3FF0000000000000u);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    exponent += 1;
  }
  // log(1 + f) = f - (f^2/2 - s (f^2/2 + R(s^2))), s = f / (2 + f), R from the series of the inverse hyperbolic
  // tangent.
  const double f = m - 1.0;
  const double s = f / (2.0 + f);
  const double z = s * s;
  double r = 2.0 / 23.0;
  for (double k = 21.0; k >= 3.0; k -= 2.0) r = r * z + 2.0 / k;
  r *= z;
  const double half_square = 0.5 * f * f;
  const double n = exponent;
  return n * ln2_high - ((half_square - (s * (half_square + r) + n * ln2_low)) - f);
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
