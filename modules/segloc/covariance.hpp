// SPDX-License-Identifier: BSD-3-Clause
// The covariance matrix of the filter: symmetric, of a size that changes, in storage of fixed capacity.
//
//   row i:  [ P(i,0) ... P(i,i) | not used ]        only the lower triangle is kept, so it is symmetric by construction
//
// Rows are padded to whole blocks of four, which is what the one costly operation works on.
#pragma once

#include <cstddef>
#include <vector>

namespace waitpoint::segloc {

class Covariance {
 public:
  /// Room for `capacity` variables; starts with none.
  explicit Covariance(std::size_t capacity);

  std::size_t size() const { return size_; }
  /// Length of a row, a multiple of four, and of the rows that subtract_products takes.
  std::size_t stride() const { return stride_; }

  double operator()(std::size_t i, std::size_t j) const { return i < j ? at(j, i) : at(i, j); }
  double& operator()(std::size_t i, std::size_t j) { return i < j ? at(j, i) : at(i, j); }

  /// Appends `count` variables, uncorrelated and without variance. Beyond the capacity is a bug.
  void append(std::size_t count);
  /// Takes out `count` variables from `first` on; the last `count` ones, if others, take their place.
  void remove(std::size_t first, std::size_t count);

  /// Writes column j, size() elements.
  void column(std::size_t j, double* out) const;

  /// P(i,j) -= sum over r of rows[r][i] rows[r][j], the sum taken in the order of r. `rows` holds `count` rows of
  /// stride() elements.
  void subtract_products(const double* rows, std::size_t count);

 private:
  double at(std::size_t i, std::size_t j) const { return values_[i * stride_ + j]; }
  double& at(std::size_t i, std::size_t j) { return values_[i * stride_ + j]; }

  std::size_t size_ = 0, capacity_, stride_;
  std::vector<double> values_;
};

}  // namespace waitpoint::segloc
