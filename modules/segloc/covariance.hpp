// SPDX-License-Identifier: BSD-3-Clause
// The covariance matrix of the filter: symmetric, of variable size, in storage of fixed capacity.
//
//   row i:  [ P(i,0) ... P(i,i) | not used ]        only the lower triangle is stored: symmetric by construction
//
// Rows are padded to whole blocks of four, the unit of the one costly operation.
#pragma once

#include <cstddef>
#include <vector>

namespace waitpoint::segloc {

class Covariance {
 public:
  /// Capacity in variables; initially empty.
  explicit Covariance(std::size_t capacity);

  std::size_t size() const { return size_; }
  /// Length of a row, and of the rows of subtract_products: a multiple of four.
  std::size_t stride() const { return stride_; }

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
  double at(std::size_t i, std::size_t j) const { return values_[i * stride_ + j]; }
  double& at(std::size_t i, std::size_t j) { return values_[i * stride_ + j]; }

  std::size_t size_ = 0, capacity_, stride_;
  std::vector<double> values_;
};

}  // namespace waitpoint::segloc
