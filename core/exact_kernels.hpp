// SPDX-License-Identifier: BSD-3-Clause
// The arithmetic of the exact functions, for one number (Number = double) or a vector of them in the vector extension
// of GCC and clang: the same operations in the same order, hence the same bits.
//
// Always inlined, into functions for any instruction set. Vectors are passed by reference and reinterpreted by a
// built-in: as values of calls, their conventions would differ between instruction sets. Arguments are those that need
// no special case, as stated with each function.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waitpoint::exact {

template <class Number>
struct Bits {  // of a vector: as many 64-bit integers
  typedef std::int64_t Type __attribute__((vector_size(sizeof(Number))));
};
template <>
struct Bits<double> {
  using Type = std::int64_t;
};

// Adding it rounds numbers up to 2^51 to the nearest integer, ties to even: the integer is in the lowest bits then.
inline constexpr double rounding = 0x1.8p52;

// Sine and cosine of finite x, |x| <= 1e6, except 0.
template <class Number>
[[gnu::always_inline]] inline void sincos_kernel(const Number& x, Number& sine, Number& cosine) {
  using Integer = typename Bits<Number>::Type;
  // pi/2 in parts of 33, 33 and 53 bits; the quadrant number has at most 20 bits.
  constexpr double first = 0x1.921fb54400000p+0, second = 0x1.0b4611a600000p-34, third = 0x1.3198a2e037073p-69;
  constexpr double per_quadrant = 2.0 / 3.14159265358979323846;
  const Number shifted = x * per_quadrant + rounding;
  const Number n = shifted - rounding;
  const Integer quadrant = __builtin_bit_cast(Integer, shifted);  // modulo 4: rounding is a multiple of 4
  const Number r = x - n * first;
  const Number w = n * second;
  const Number sum = r - w;
  const Number undone = sum + w;
  const Number error = (r - undone) - (sum - (undone - w));
  const Number whole_tail = error - n * third;
  const Number y = sum + whole_tail;
  const Number tail = (sum - y) + whole_tail;

  const Number z = y * y;
  Number s = z * (1.0 / 355687428096000.0) - 1.0 / 1307674368000.0;  // 1/17!, 1/15!
  s = s * z + 1.0 / 6227020800.0;
  s = s * z - 1.0 / 39916800.0;
  s = s * z + 1.0 / 362880.0;
  s = s * z - 1.0 / 5040.0;
  s = s * z + 1.0 / 120.0;
  s = s * z - 1.0 / 6.0;
  Number c = z * (1.0 / 20922789888000.0) - 1.0 / 87178291200.0;  // 1/16!, 1/14!
  c = c * z + 1.0 / 479001600.0;
  c = c * z - 1.0 / 3628800.0;
  c = c * z + 1.0 / 40320.0;
  c = c * z - 1.0 / 720.0;
  c = c * z + 1.0 / 24.0;
  const Number half = 0.5 * z;
  const Number rest = 1.0 - half;
  const Number kernel_sine = y + (y * z * s + tail * rest);
  const Number kernel_cosine = rest + (((1.0 - rest) - half) + (z * z * c - y * tail));

  // Odd quadrants exchange the two; the sign of the sine is that of quadrant bit 1, of the cosine that of the next
  // quadrant's.
  const Integer sine_bits = __builtin_bit_cast(Integer, kernel_sine),
                cosine_bits = __builtin_bit_cast(Integer, kernel_cosine);
  const Integer exchange = -(quadrant & 1);
  sine = __builtin_bit_cast(Number,
                            Integer(((sine_bits & ~exchange) | (cosine_bits & exchange)) ^ ((quadrant & 2) << 62)));
  cosine = __builtin_bit_cast(
      Number, Integer(((cosine_bits & ~exchange) | (sine_bits & exchange)) ^ (((quadrant + 1) & 2) << 62)));
}

struct Split {
  double high, low;
};

inline constexpr Split arctangent_of_sixteenths[17] = {
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
inline constexpr Split half_pi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
inline constexpr Split whole_pi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

/// The table's entries for one index, or for a vector of them.
[[gnu::always_inline]] inline void look_up(std::int64_t index, double& high, double& low) {
  high = arctangent_of_sixteenths[index].high;
  low = arctangent_of_sixteenths[index].low;
}
template <class Integer, class Number>
[[gnu::always_inline]] inline void look_up(const Integer& index, Number& high, Number& low) {
  for (std::size_t lane = 0; lane < sizeof(Number) / sizeof(double); ++lane) {
    high[lane] = arctangent_of_sixteenths[index[lane]].high;
    low[lane] = arctangent_of_sixteenths[index[lane]].low;
  }
}

// The angle of (x, y) with y not 0 and the greater of |x|, |y| between 2^-900 and 2^1000.
template <class Number>
[[gnu::always_inline]] inline void atan2_kernel(const Number& y, const Number& x, Number& angle) {
  using Integer = typename Bits<Number>::Type;
  constexpr std::int64_t magnitude = 0x7FFFFFFFFFFFFFFF;
  const Integer x_bits = __builtin_bit_cast(Integer, x), y_bits = __builtin_bit_cast(Integer, y);
  const Integer ax_bits = x_bits & magnitude, ay_bits = y_bits & magnitude;
  // All bits where |y| > |x|: positive numbers are ordered as their bits. All bits where x is negative.
  const Integer steep = (ax_bits - ay_bits) >> 63, behind = x_bits >> 63;
  const Number small = __builtin_bit_cast(Number, Integer((ay_bits & ~steep) | (ax_bits & steep)));
  const Number large = __builtin_bit_cast(Number, Integer((ax_bits & ~steep) | (ay_bits & steep)));

  // Arctangent of small / large.
  const Number shifted = small / large * 16.0 + rounding;
  const Number c = (shifted - rounding) / 16.0;
  const Number z = (small - c * large) / (large + c * small);  // |z| <= 1/32
  const Number z2 = z * z;
  Number series = z2 * (-1.0 / 11.0) + 1.0 / 9.0;
  series = series * z2 - 1.0 / 7.0;
  series = series * z2 + 1.0 / 5.0;
  series = series * z2 - 1.0 / 3.0;
  Number table_high{}, table_low{};  // filled lane by lane
  look_up(Integer(__builtin_bit_cast(Integer, shifted) & 31), table_high, table_low);
  const Number rest = z + (z * z2 * series + table_low);
  const Number high = table_high + rest;
  const Number low = (table_high - high) + rest;

  // To the octant: from 0, pi/2 or pi, forwards or back.
  const Integer back = steep ^ behind;
  const Integer half_turn = behind & ~steep;
  const Number base_high =
      __builtin_bit_cast(Number, Integer((steep & __builtin_bit_cast(std::int64_t, half_pi.high)) |
                                         (half_turn & __builtin_bit_cast(std::int64_t, whole_pi.high))));
  const Number base_low =
      __builtin_bit_cast(Number, Integer((steep & __builtin_bit_cast(std::int64_t, half_pi.low)) |
                                         (half_turn & __builtin_bit_cast(std::int64_t, whole_pi.low))));
  const Integer sign = (back & ~magnitude);
  const Number signed_high = __builtin_bit_cast(Number, Integer(__builtin_bit_cast(Integer, high) ^ sign));
  const Number signed_low = __builtin_bit_cast(Number, Integer(__builtin_bit_cast(Integer, low) ^ sign));
  const Number turned = base_high + (signed_high + (base_low + signed_low));
  angle = __builtin_bit_cast(Number, Integer(__builtin_bit_cast(Integer, turned) ^ (y_bits & ~magnitude)));
}

inline constexpr double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33;

// The logarithm of 2^`more` times the normal number x > 0.
template <class Number>
[[gnu::always_inline]] inline void log_kernel(const Number& x, std::int64_t more, Number& logarithm) {
  using Integer = typename Bits<Number>::Type;
  const Integer bits = __builtin_bit_cast(Integer, x);
  const Integer mantissa = bits & 0x000FFFFFFFFFFFFF;
  // Above the square root of 2 the mantissa is halved.
  constexpr std::int64_t root_2 = 0x6A09E667F3BCD;
  const Integer above = (root_2 - mantissa) >> 63;
  const Number m = __builtin_bit_cast(Number, Integer(mantissa | (0x3FF0000000000000 + (above << 52))));
  const Integer exponent = (bits >> 52) - 1023 + more - above;
  const Number n =
      __builtin_bit_cast(Number, Integer(exponent + __builtin_bit_cast(std::int64_t, rounding))) - rounding;
  // log(1 + f) = f - (f^2/2 - s (f^2/2 + R(s^2))), s = f / (2 + f), R from the series of the inverse hyperbolic
  // tangent.
  const Number f = m - 1.0;
  const Number s = f / (2.0 + f);
  const Number z = s * s;
  Number r = z * (2.0 / 23.0) + 2.0 / 21.0;
  r = r * z + 2.0 / 19.0;
  r = r * z + 2.0 / 17.0;
  r = r * z + 2.0 / 15.0;
  r = r * z + 2.0 / 13.0;
  r = r * z + 2.0 / 11.0;
  r = r * z + 2.0 / 9.0;
  r = r * z + 2.0 / 7.0;
  r = r * z + 2.0 / 5.0;
  r = r * z + 2.0 / 3.0;
  r = r * z;
  const Number half_square = 0.5 * f * f;
  logarithm = n * ln2_high - ((half_square - (s * (half_square + r) + n * ln2_low)) - f);
}

}  // namespace waitpoint::exact
