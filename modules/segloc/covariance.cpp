// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/covariance.hpp"

#include <cstring>

#include "core/error.hpp"

namespace waitpoint::segloc {
namespace {

// Two doubles processed at once. The operations on each element and their order are those of scalar code, so the result
// is bit-identical with and without vector instructions.
using Pair = double __attribute__((vector_size(16)));

inline Pair load(const double* from) {
  Pair p;
  std::memcpy(&p, from, sizeof p);
  return p;
}

inline void subtract(double* from, Pair p) {
  const Pair rest = load(from) - p;
  std::memcpy(from, &rest, sizeof rest);
}

// A block of four by four, whose sums stay in registers.
void subtract_block(double* values, std::size_t row_length, const double* left, const double* right, std::size_t stride,
                    std::size_t count) {
  Pair a0{}, a1{}, b0{}, b1{}, c0{}, c1{}, d0{}, d1{};
  for (std::size_t r = 0; r < count; ++r, left += stride, right += stride) {
    const Pair low = load(right), high = load(right + 2);
    const Pair a{left[0], left[0]}, b{left[1], left[1]}, c{left[2], left[2]}, d{left[3], left[3]};
    a0 += a * low;
    a1 += a * high;
    b0 += b * low;
    b1 += b * high;
    c0 += c * low;
    c1 += c * high;
    d0 += d * low;
    d1 += d * high;
  }
  subtract(values, a0);
  subtract(values + 2, a1);
  subtract(values + row_length, b0);
  subtract(values + row_length + 2, b1);
  subtract(values + 2 * row_length, c0);
  subtract(values + 2 * row_length + 2, c1);
  subtract(values + 3 * row_length, d0);
  subtract(values + 3 * row_length + 2, d1);
}

}  // namespace

Covariance::Covariance(std::size_t capacity) : capacity_(capacity) {}

void Covariance::append(std::size_t count) {
  WAITPOINT_CHECK(size_ + count <= capacity_, "more variables than the covariance has room for");
  const std::size_t first = size_;
  size_ += count;
  if (const std::size_t needed = row(stride()); needed > values_.size()) {
    if (needed > values_.capacity()) values_.reserve(needed + needed / 4);
    values_.resize(needed, 0.0);
  }
  for (std::size_t i = first; i < size_; ++i) {
    for (std::size_t j = 0; j <= i; ++j) at(i, j) = 0;
  }
}

void Covariance::remove(std::size_t first, std::size_t count) {
  WAITPOINT_CHECK(first + count <= size_, "removing variables that are not there");
  const std::size_t rest = size_ - count;
  WAITPOINT_CHECK(first + count <= rest || first == rest, "the variables that move overlap those removed");
  if (first < rest) {
    for (std::size_t k = 0; k < count; ++k) {
      for (std::size_t j = 0; j < rest; ++j) {
        if (j < first || j >= first + count) (*this)(first + k, j) = (*this)(rest + k, j);
      }
      for (std::size_t j = 0; j <= k; ++j) (*this)(first + k, first + j) = (*this)(rest + k, rest + j);
    }
  }
  size_ = rest;
}

void Covariance::column(std::size_t j, double* out) const {
  for (std::size_t i = 0; i < j; ++i) out[i] = at(j, i);
  for (std::size_t i = j; i < size_; ++i) out[i] = at(i, j);
}

void Covariance::subtract_products(const double* rows, std::size_t count) {
  for (std::size_t i = 0; i < size_; i += block) {
    const std::size_t row_length = i + block;
    double* const band = &at(i, 0);
    for (std::size_t j = 0; j <= i; j += block) {
      subtract_block(band + j, row_length, rows + i, rows + j, stride(), count);
    }
  }
}

}  // namespace waitpoint::segloc
