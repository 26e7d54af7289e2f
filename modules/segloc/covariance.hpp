// SPDX-License-Identifier: BSD-3-Clause
// The covariance matrix of the filter: symmetric, of variable size up to a capacity.
//
//   row i:  [ P(i,0) ... P(i,i) | not used ]        only the lower triangle is stored: symmetric by construction
//
// Rows are padded to whole blocks of four, the unit of the one costly operation: four rows of equal length are a band,
// of 4, 8, 12 ... elements per row, one after the other. So the matrix grows at its end, and takes the memory of the
// variables that it has had: with a map's usual landmarks a tenth of that for the greatest number.
#pragma once

#include <cstddef>
#include <vector>

namespace waitpoint::segloc {

class Covariance {
 public:
  /// Capacity in variables; initially empty.
  explicit Covariance(std::size_t capacity);

  std::size_t size() const { return size_; }
  /// Length of the rows of subtract_products: the size, rounded up to a multiple of four.
  std::size_t stride() const { return (size_ + block - 1) / block * block; }

  double operator()(std::size_t i, std::size_t j) const { return i < j ? at(j, i) : at(i, j); }
  double& operator()(std::size_t i, std::size_t j) { return i < j ? at(j, i) : at(i, j); }

  /// Appends `count` variables with zero variance and covariance. Exceeding the capacity is a bug.
  void append(std::size_t count);
  /// Removes `count` variables from `first` on; the last `count` variables, unless the same, move into their place.
  void remove(std::size_t first, std::size_t count);

  /// Writes column j, size() elements.
  void column(std::size_t j, double* out) const;

  /// P(i,j) -= sum over r of rows[r][i] rows[r][j], summed in the order of r. `rows` holds `count` rows of stride()
  /// elements.
  void subtract_products(const double* rows, std::size_t count);

 private:
  static constexpr std::size_t block = 4;

  /// The index of a row's first element: band k follows k bands of 4 (4 + 8 + ... + 4 k) elements.
  static constexpr std::size_t row(std::size_t i) {
    const std::size_t band = i / block;
    return block * (band + 1) * (2 * band + i % block);
  }
  double at(std::size_t i, std::size_t j) const { return values_[row(i) + j]; }
  double& at(std::size_t i, std::size_t j) { return values_[row(i) + j]; }

  std::size_t size_ = 0, capacity_;
  std::vector<double> values_;  // whole bands
};

}  // namespace waitpoint::segloc
