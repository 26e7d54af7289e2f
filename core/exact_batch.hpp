// SPDX-License-Identifier: BSD-3-Clause
// Exact functions of many numbers at once: the bits of core/exact_math.hpp for each, by the processor's widest vectors.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace waitpoint::exact {

/// Sines and cosines of as many angles; special values as for one.
void sincos(std::span<const double> angles, std::span<double> sines, std::span<double> cosines);
/// The angles of the points (x, y).
void atan2(std::span<const double> y, std::span<const double> x, std::span<double> angles);
/// Natural logarithms.
void log(std::span<const double> x, std::span<double> logarithms);

/// The functions by vectors of one width.
struct BatchFunctions {
  const char* instruction_set;
  void (*sincos)(std::span<const double> x, double* sines, double* cosines);
  void (*atan2)(std::span<const double> y, const double* x, double* angles);
  void (*log)(std::span<const double> x, double* logarithms);
};
/// Those of this processor, from the narrowest, for every processor, to the widest, which the functions above use.
std::vector<BatchFunctions> all_batch_functions();

/// How many numbers users pass at a time: in arrays on the stack of a task.
inline constexpr std::size_t batch = 64;

}  // namespace waitpoint::exact
