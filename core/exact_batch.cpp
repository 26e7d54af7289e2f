// SPDX-License-Identifier: BSD-3-Clause
//
// Every function exists once per width of vectors, compiled for an instruction set that has it. A vector with an
// argument that needs a special case, and the rest of a batch, go through the function of one number.
#include "core/exact_batch.hpp"

#include <limits>

#include "core/error.hpp"
#include "core/exact_kernels.hpp"
#include "core/exact_math.hpp"
#include "core/instructions.hpp"

namespace waitpoint::exact {
namespace {

template <std::size_t bytes>
struct Lanes {
  typedef double Doubles __attribute__((vector_size(bytes)));
  static constexpr std::size_t count = bytes / sizeof(double);
};

template <class Doubles>
[[gnu::always_inline]] inline void load(Doubles& vector, const double* from) {
  __builtin_memcpy(&vector, from, sizeof vector);
}
template <class Doubles>
[[gnu::always_inline]] inline void store(const Doubles& vector, double* to) {
  __builtin_memcpy(to, &vector, sizeof vector);
}

// True if all lanes of a mask are set.
template <class Mask>
[[gnu::always_inline]] inline bool all(const Mask& mask) {
  std::int64_t set = -1;
  for (std::size_t lane = 0; lane < sizeof(Mask) / sizeof(double); ++lane) set &= mask[lane];
  return set != 0;
}

template <class Doubles>
[[gnu::always_inline]] inline void absolute(const Doubles& x, Doubles& magnitude) {
  using Integers = typename Bits<Doubles>::Type;
  magnitude = __builtin_bit_cast(Doubles, Integers(__builtin_bit_cast(Integers, x) & 0x7FFFFFFFFFFFFFFF));
}

void sincos_of_one(double x, double& sine, double& cosine) {
  const SinCos both = sincos(x);
  sine = both.sin;
  cosine = both.cos;
}

template <std::size_t bytes>
[[gnu::always_inline]] inline void sincos_in(std::span<const double> x, double* sines, double* cosines) {
  constexpr std::size_t lanes = Lanes<bytes>::count;
  std::size_t i = 0;
  for (; i + lanes <= x.size(); i += lanes) {
    typename Lanes<bytes>::Doubles angle, magnitude, sine, cosine;
    load(angle, &x[i]);
    absolute(angle, magnitude);
    if (!all((magnitude > 0.0) & (magnitude <= 1e6))) {
      for (std::size_t k = i; k < i + lanes; ++k) sincos_of_one(x[k], sines[k], cosines[k]);
      continue;
    }
    sincos_kernel(angle, sine, cosine);
    store(sine, sines + i);
    store(cosine, cosines + i);
  }
  for (; i < x.size(); ++i) sincos_of_one(x[i], sines[i], cosines[i]);
}

template <std::size_t bytes>
[[gnu::always_inline]] inline void atan2_in(std::span<const double> y, const double* x, double* angles) {
  constexpr std::size_t lanes = Lanes<bytes>::count;
  std::size_t i = 0;
  for (; i + lanes <= y.size(); i += lanes) {
    typename Lanes<bytes>::Doubles down, across, down_size, across_size, angle;
    load(down, &y[i]);
    load(across, x + i);
    absolute(down, down_size);
    absolute(across, across_size);
    if (!all((down_size > 0.0) & (down_size <= 0x1p1000) & (across_size <= 0x1p1000) &
             ((down_size >= 0x1p-900) | (across_size >= 0x1p-900)))) {
      for (std::size_t k = i; k < i + lanes; ++k) angles[k] = atan2(y[k], x[k]);
      continue;
    }
    atan2_kernel(down, across, angle);
    store(angle, angles + i);
  }
  for (; i < y.size(); ++i) angles[i] = atan2(y[i], x[i]);
}

template <std::size_t bytes>
[[gnu::always_inline]] inline void log_in(std::span<const double> x, double* logarithms) {
  constexpr std::size_t lanes = Lanes<bytes>::count;
  std::size_t i = 0;
  for (; i + lanes <= x.size(); i += lanes) {
    typename Lanes<bytes>::Doubles number, logarithm;
    load(number, &x[i]);
    if (!all((number >= std::numeric_limits<double>::min()) & (number <= std::numeric_limits<double>::max()))) {
      for (std::size_t k = i; k < i + lanes; ++k) logarithms[k] = log(x[k]);
      continue;
    }
    log_kernel(number, 0, logarithm);
    store(logarithm, logarithms + i);
  }
  for (; i < x.size(); ++i) logarithms[i] = log(x[i]);
}

void sincos_16(std::span<const double> x, double* sines, double* cosines) { sincos_in<16>(x, sines, cosines); }
void atan2_16(std::span<const double> y, const double* x, double* angles) { atan2_in<16>(y, x, angles); }
void log_16(std::span<const double> x, double* logarithms) { log_in<16>(x, logarithms); }

#if WAITPOINT_X86_64
#define WAITPOINT_AVX2 __attribute__((target("avx2")))
WAITPOINT_AVX2 void sincos_32(std::span<const double> x, double* sines, double* cosines) {
  sincos_in<32>(x, sines, cosines);
}
WAITPOINT_AVX2 void atan2_32(std::span<const double> y, const double* x, double* angles) { atan2_in<32>(y, x, angles); }
WAITPOINT_AVX2 void log_32(std::span<const double> x, double* logarithms) { log_in<32>(x, logarithms); }

#define WAITPOINT_AVX512 __attribute__((target("avx512f,avx512dq")))
WAITPOINT_AVX512 void sincos_64(std::span<const double> x, double* sines, double* cosines) {
  sincos_in<64>(x, sines, cosines);
}
WAITPOINT_AVX512 void atan2_64(std::span<const double> y, const double* x, double* angles) {
  atan2_in<64>(y, x, angles);
}
WAITPOINT_AVX512 void log_64(std::span<const double> x, double* logarithms) { log_in<64>(x, logarithms); }
#endif

const BatchFunctions& functions() {
  static const BatchFunctions widest = all_batch_functions().back();
  return widest;
}

}  // namespace

std::vector<BatchFunctions> all_batch_functions() {
  std::vector<BatchFunctions> all = {{WAITPOINT_X86_64 ? "SSE2" : "two lanes", sincos_16, atan2_16, log_16}};
#if WAITPOINT_X86_64
  if (__builtin_cpu_supports("avx2")) all.push_back({"AVX2", sincos_32, atan2_32, log_32});
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
    all.push_back({"AVX-512", sincos_64, atan2_64, log_64});
#endif
  return all;
}

void sincos(std::span<const double> angles, std::span<double> sines, std::span<double> cosines) {
  WAITPOINT_CHECK(sines.size() >= angles.size() && cosines.size() >= angles.size(), "no room for the results");
  functions().sincos(angles, sines.data(), cosines.data());
}

void atan2(std::span<const double> y, std::span<const double> x, std::span<double> angles) {
  WAITPOINT_CHECK(x.size() == y.size() && angles.size() >= y.size(), "no room for the results");
  functions().atan2(y, x.data(), angles.data());
}

void log(std::span<const double> x, std::span<double> logarithms) {
  WAITPOINT_CHECK(logarithms.size() >= x.size(), "no room for the results");
  functions().log(x, logarithms.data());
}

}  // namespace waitpoint::exact
