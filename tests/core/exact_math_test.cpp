// SPDX-License-Identifier: BSD-3-Clause
#include "core/exact_math.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace waitpoint::exact {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double tiny = std::numeric_limits<double>::denorm_min();
constexpr double huge = std::numeric_limits<double>::max();

// The error of `value` in units in the last place of the exact result.
double ulps(double value, long double exact) {
  const double nearest = std::fabs(static_cast<double>(exact));
  const double ulp = std::nextafter(nearest, inf) - nearest;
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact) / ulp);
}

class Draws {
 public:
  explicit Draws(const char* name) : random_(1, "", name) {}
  double between(double low, double high) { return low + (high - low) * random_.uniform(++tick_); }
  double magnitude(int least, int most) {
    const double mantissa = between(1, 2);
    const double exponent = between(least, most);
    const double sign = between(-1, 1);
    return std::copysign(std::ldexp(mantissa, static_cast<int>(exponent)), sign);
  }

 private:
  RandomStream random_;
  std::uint64_t tick_ = 0;
};

bool same_zero(double a, double b) { return a == 0 && b == 0 && std::signbit(a) == std::signbit(b); }

TEST(ExactMath, SineAndCosineAreWithinTwoUlps) {
  Draws draw("sincos");
  double worst = 0;
  const auto check = [&](double x) {
    const auto [s, c] = sincos(x);
    worst = std::max({worst, ulps(s, sinl(x)), ulps(c, cosl(x))});
    EXPECT_EQ(s, sin(x));
    EXPECT_EQ(c, cos(x));
  };
  for (int i = 0; i < 50000; ++i) {
    check(draw.between(-4, 4));
    check(draw.between(-1e6, 1e6));
    check(draw.magnitude(-300, 19));
  }
  // The reduction loses most precision near multiples of pi/2.
  for (int k = -200000; k <= 200000; k += 37) check(k * (pi / 2));
  EXPECT_LE(worst, 2.0);
}

TEST(ExactMath, ArctangentIsWithinTwoUlps) {
  Draws draw("atan2");
  double worst = 0;
  const auto check = [&](double y, double x) { worst = std::max(worst, ulps(atan2(y, x), atan2l(y, x))); };
  for (int i = 0; i < 50000; ++i) {
    const double y = draw.between(-10, 10);
    check(y, draw.between(-10, 10));
    const double far_y = draw.magnitude(-400, 400);
    check(far_y, draw.magnitude(-400, 400));
    const double axis = draw.magnitude(-60, 0);
    check(axis, 1), check(axis, -1), check(1, axis), check(-1, axis);
  }
  EXPECT_LE(worst, 2.0);
}

TEST(ExactMath, ArctangentNeitherOverflowsNorLosesBitsAtTheEndsOfTheRange) {
  Draws draw("atan2 ends");
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const double y = draw.between(-1, 1), x = draw.between(-1, 1);
    worst = std::max(worst, ulps(atan2(y * huge, x * huge), atan2l(y * huge, x * huge)));
    const double small_y = y * 1e-310, small_x = x * 1e-310;
    worst = std::max(worst, ulps(atan2(small_y, small_x), atan2l(small_y, small_x)));
    const double few_y = std::ceil(y * 100) * tiny, few_x = std::ceil(x * 100) * tiny;
    if (few_x != 0 && few_y != 0) worst = std::max(worst, ulps(atan2(few_y, few_x), atan2l(few_y, few_x)));
  }
  EXPECT_LE(worst, 2.0);
}

TEST(ExactMath, ExponentialAndLogarithmAreWithinTwoUlps) {
  Draws draw("exp");
  double worst_exp = 0, worst_log = 0;
  for (int i = 0; i < 50000; ++i) {
    for (const double x : {draw.between(-745, 709.78), draw.between(-1, 1), draw.magnitude(-60, -1)})
      worst_exp = std::max(worst_exp, ulps(exp(x), expl(x)));
    for (const double x : {draw.between(0.5, 2), std::fabs(draw.magnitude(-1070, 1023)), draw.between(1e-9, 1e9),
                           1 + draw.magnitude(-50, -4)})
      worst_log = std::max(worst_log, ulps(log(x), logl(x)));
  }
  EXPECT_LE(worst_exp, 2.0);
  EXPECT_LE(worst_log, 2.0);
}

TEST(ExactMath, SpecialValuesOfSineAndCosine) {
  EXPECT_TRUE(same_zero(sin(0.0), 0.0));
  EXPECT_TRUE(same_zero(sin(-0.0), -0.0));
  EXPECT_EQ(cos(0.0), 1.0);
  EXPECT_EQ(sin(tiny), tiny);
  EXPECT_TRUE(std::isnan(sin(nan)));
  EXPECT_TRUE(std::isnan(cos(nan)));
  EXPECT_DEATH(sin(1.0000001e6), "an angle beyond 1e6 rad");
  EXPECT_DEATH(cos(-inf), "an angle beyond 1e6 rad");
}

TEST(ExactMath, SpecialValuesOfTheArctangent) {
  for (const double y : {0.0, -0.0, 1.0, -1.0, tiny, -tiny, huge, inf, -inf})
    for (const double x : {0.0, -0.0, 1.0, -1.0, tiny, -tiny, huge, -huge, inf, -inf}) {
      const double ours = atan2(y, x), expected = std::atan2(y, x);
      EXPECT_EQ(std::signbit(ours), std::signbit(expected)) << y << " " << x;
      EXPECT_DOUBLE_EQ(ours, expected) << y << " " << x;
    }
  EXPECT_TRUE(std::isnan(atan2(nan, 1)));
  EXPECT_TRUE(std::isnan(atan2(1, nan)));
}

TEST(ExactMath, SpecialValuesOfExponentialAndLogarithm) {
  EXPECT_EQ(exp(0.0), 1.0);
  EXPECT_EQ(exp(inf), inf);
  EXPECT_EQ(exp(-inf), 0.0);
  EXPECT_EQ(exp(709.782712893384), std::exp(709.782712893384));
  EXPECT_EQ(exp(709.79), inf);
  EXPECT_EQ(exp(-745.1), tiny);
  EXPECT_EQ(exp(-745.2), 0.0);
  EXPECT_TRUE(std::isnan(exp(nan)));
  EXPECT_TRUE(same_zero(log(1.0), 0.0));
  EXPECT_EQ(log(0.0), -inf);
  EXPECT_EQ(log(-0.0), -inf);
  EXPECT_EQ(log(inf), inf);
  EXPECT_TRUE(std::isnan(log(-1.0)));
  EXPECT_TRUE(std::isnan(log(nan)));
}

TEST(ExactMath, WrappingKeepsTheAngleAndItsRange) {
  Draws draw("wrap");
  for (int i = 0; i < 20000; ++i) {
    const double x = draw.between(-50, 50);
    const double wrapped = wrap_angle(x);
    EXPECT_GT(wrapped, -pi);
    EXPECT_LE(wrapped, pi);
    EXPECT_NEAR(std::remainder(x - wrapped, 2 * pi), 0, 1e-13);
  }
  EXPECT_EQ(wrap_angle(pi), pi);
  EXPECT_EQ(wrap_angle(-pi), pi);
  EXPECT_EQ(wrap_angle(3 * pi), pi);
  EXPECT_EQ(wrap_angle(-3 * pi), pi);
  EXPECT_EQ(wrap_angle(2 * pi), 0);
  EXPECT_EQ(wrap_angle(0.3), 0.3);
  EXPECT_TRUE(std::isnan(wrap_angle(nan)));
}

// The same bits from every compiler, at every optimisation level, on every CPU. It changes only with a function.
TEST(ExactMath, TheFingerprintIsTheRecordedOne) { EXPECT_EQ(fingerprint(), 1002389924957023670u); }

}  // namespace
}  // namespace waitpoint::exact
