// SPDX-License-Identifier: BSD-3-Clause
// SIMD vectors of each width, in the vector extension of GCC and clang. The only source with intrinsics: where the
// extension does not lead to one instruction, there is one for SSE2, AVX, AVX-512 and NEON, and a loop that gives the
// same bits.
//
// Each instruction set has its own source, compiled for it (kernels_*.cpp). Such a source must not emit a function that
// the linker could choose for other sources: it calls no inline function from elsewhere, and its own are templates
// distinguished by `lanes` and `set`.
#pragma once

#include <cstdint>

#include "core/instructions.hpp"
#if WAITPOINT_X86_64
#include <immintrin.h>
#elif WAITPOINT_AARCH64
#include <arm_neon.h>
#endif

namespace waitpoint::world {

/// Those of the processor that the source is compiled for, or the compiler's vectors of loops.
enum class Instructions { own, portable };

/// Vectors of `lanes` doubles or 64-bit integers, and of as many floats or 32-bit integers as fit, at most eight.
template <int lanes>
struct VectorTypes;
template <>
struct VectorTypes<2> {
  typedef double Doubles __attribute__((vector_size(16)));
  typedef std::int64_t Longs __attribute__((vector_size(16)));
  typedef float Floats __attribute__((vector_size(16)));
  typedef std::int32_t Ints __attribute__((vector_size(16)));
};
template <>
struct VectorTypes<4> {
  typedef double Doubles __attribute__((vector_size(32)));
  typedef std::int64_t Longs __attribute__((vector_size(32)));
  typedef float Floats __attribute__((vector_size(32)));
  typedef std::int32_t Ints __attribute__((vector_size(32)));
};
template <>
struct VectorTypes<8> {
  typedef double Doubles __attribute__((vector_size(64)));
  typedef std::int64_t Longs __attribute__((vector_size(64)));
  typedef float Floats __attribute__((vector_size(32)));
  typedef std::int32_t Ints __attribute__((vector_size(32)));
};

/// Operations on such vectors. Both sets give the same bits for all numbers, infinities, denormal ones and zeros of
/// either sign included, and a NaN for the same arguments.
template <int lanes, Instructions set = Instructions::own>
struct Vectors {
  static constexpr bool has_intrinsics = set == Instructions::own;
  using Doubles = typename VectorTypes<lanes>::Doubles;
  using Longs = typename VectorTypes<lanes>::Longs;
  using Floats = typename VectorTypes<lanes>::Floats;
  using Ints = typename VectorTypes<lanes>::Ints;
  static constexpr int float_lanes = sizeof(Floats) / sizeof(float);
  static_assert(sizeof(Doubles) == lanes * sizeof(double) && sizeof(Longs) == sizeof(Doubles),
                "a mask of doubles has as many lanes as the doubles");
  static_assert(sizeof(Ints) == sizeof(Floats), "a mask of floats has as many lanes as the floats");
  static_assert(float_lanes >= lanes && float_lanes <= 8,
                "a vector of floats is wider than a node or narrower than one of doubles");

  template <class Vector, class Element>
  static Vector load(const Element* from) {
    Vector v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
  }
  template <class Vector, class Element>
  static void store(Element* to, Vector v) {
    __builtin_memcpy(to, &v, sizeof v);
  }

  static Doubles all(double value) { return value - Doubles{}; }
  static Floats all(float value) { return value - Floats{}; }
  static Doubles absolute(Doubles v) { return (Doubles)((Longs)v & 0x7FFFFFFFFFFFFFFF); }
  static Floats absolute(Floats v) { return (Floats)((Ints)v & 0x7FFFFFFF); }
  template <class Vector>
  static Vector least(Vector a, Vector b) {
    return b < a ? b : a;
  }
  template <class Vector>
  static Vector greatest(Vector a, Vector b) {
    return a < b ? b : a;
  }

  // The maximum of all lanes, by halves.
  static double greatest_of(Doubles v) {
    if constexpr (lanes == 8) v = greatest(v, __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3));
    if constexpr (lanes == 8) v = greatest(v, __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5));
    if constexpr (lanes == 4) v = greatest(v, __builtin_shufflevector(v, v, 2, 3, 0, 1));
    return v[0] < v[1] ? v[1] : v[0];
  }

  static Floats gather(const float* from, Ints at) {
#if WAITPOINT_X86_64 && defined(__AVX2__)
    if constexpr (has_intrinsics && float_lanes == 8)
      return (Floats)_mm256_i32gather_ps(from, (__m256i)at, sizeof(float));
#endif
    Floats v;
    for (int i = 0; i < float_lanes; ++i) v[i] = from[at[i]];
    return v;
  }

  static Doubles root(Doubles v) {
#if WAITPOINT_X86_64
#if defined(__AVX512F__)
    // Not _mm512_sqrt_pd(), in whose header GCC 12 finds an uninitialised value (its bug 105593).
    if constexpr (has_intrinsics && lanes == 8) return (Doubles)_mm512_maskz_sqrt_pd(0xFF, (__m512d)v);
#endif
#if defined(__AVX__)
    if constexpr (has_intrinsics && lanes == 4) return (Doubles)_mm256_sqrt_pd((__m256d)v);
#endif
    if constexpr (has_intrinsics && lanes == 2) return (Doubles)_mm_sqrt_pd((__m128d)v);
#elif WAITPOINT_AARCH64
    if constexpr (has_intrinsics && lanes == 2) return (Doubles)vsqrtq_f64((float64x2_t)v);
#endif
    for (int i = 0; i < lanes; ++i) v[i] = __builtin_sqrt(v[i]);
    return v;
  }

  // A bit per lane whose bits are all ones; in the others all are zeros.
  static unsigned bits(Longs mask) {
#if WAITPOINT_X86_64
#if defined(__AVX512DQ__)
    if constexpr (has_intrinsics && lanes == 8) return _mm512_movepi64_mask((__m512i)mask);
#endif
#if defined(__AVX__)
    if constexpr (has_intrinsics && lanes == 4) return static_cast<unsigned>(_mm256_movemask_pd((__m256d)mask));
#endif
    if constexpr (has_intrinsics && lanes == 2) return static_cast<unsigned>(_mm_movemask_pd((__m128d)mask));
#elif WAITPOINT_AARCH64
    if constexpr (has_intrinsics && lanes == 2)
      return static_cast<unsigned>(vaddvq_u64(vandq_u64((uint64x2_t)mask, uint64x2_t{1, 2})));
#endif
    unsigned in_lanes = 0;
    for (int i = 0; i < lanes; ++i) in_lanes |= mask[i] != 0 ? 1u << i : 0u;
    return in_lanes;
  }
  static unsigned bits(Ints mask) {
#if WAITPOINT_X86_64
#if defined(__AVX__)
    if constexpr (has_intrinsics && float_lanes == 8) return static_cast<unsigned>(_mm256_movemask_ps((__m256)mask));
#endif
    if constexpr (has_intrinsics && float_lanes == 4) return static_cast<unsigned>(_mm_movemask_ps((__m128)mask));
#elif WAITPOINT_AARCH64
    if constexpr (has_intrinsics && float_lanes == 4)
      return vaddvq_u32(vandq_u32((uint32x4_t)mask, uint32x4_t{1, 2, 4, 8}));
#endif
    unsigned in_lanes = 0;
    for (int i = 0; i < float_lanes; ++i) in_lanes |= mask[i] != 0 ? 1u << i : 0u;
    return in_lanes;
  }
};

}  // namespace waitpoint::world
