// SPDX-License-Identifier: BSD-3-Clause
// One Kalman update from many observations, accumulated one pair of rows at a time.
//
// With H the rows accepted so far, R their noise, L L' = H P H' + R and W = P H' L'^-1, the update is
//
//   x += W y,  L y = innovation        P -= W W'
//
// A further pair of rows h needs of L only h W, and its innovation given all accepted ones is
//
//   v - (h W) y       with covariance       h P h' + r - (h W)(h W)'
//
// So each candidate match is tested jointly with the accepted ones (the joint compatibility test of Neira and Tardos,
// 2001, applied greedily), and P, the costly part, is updated once, at the end. h has at most five columns: the pose
// and one line, or two lines.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "modules/segloc/covariance.hpp"

namespace waitpoint::segloc {

/// Two rows of a measurement: observed minus predicted, derivatives of the prediction, and noise.
struct RowPair {
  std::size_t columns = 0;
  std::array<std::size_t, 5> column{};
  std::array<std::array<double, 5>, 2> derivative{};
  std::array<double, 2> innovation{};
  std::array<double, 3> noise{};  ///< (0, 0), (0, 1), (1, 1)

  void add_column(std::size_t index, double first, double second) {
    column[columns] = index;
    derivative[0][columns] = first;
    derivative[1][columns] = second;
    ++columns;
  }
};

class JointUpdate {
 public:
  /// Holds up to `pairs` row pairs.
  explicit JointUpdate(std::size_t pairs);

  /// Begins an update of `covariance`, whose size must not change until it is applied.
  void clear(const Covariance& covariance);
  bool full() const { return rows_ == rows_max_; }
  bool empty() const { return rows_ == 0; }

  /// A pair of rows compared with the prediction from the pairs accepted so far.
  struct Trial {
    double squared_distance = 0;  ///< chi2-distributed with two degrees of freedom for a correct match
    double information = 0;       ///< trace of noise^-1 times the prediction's covariance
  };
  /// Evaluates a pair; may be followed by `accept` of the same pair.
  Trial test(const Covariance& covariance, const RowPair& pair);
  /// Adds the pair tested last. Exceeding the number of pairs is a bug.
  void accept(const Covariance& covariance, const RowPair& pair);

  /// The correction of state variable i by the accepted pairs.
  double correction(std::size_t i) const;
  /// Updates the covariance by the accepted pairs.
  void apply(Covariance& covariance) const { covariance.subtract_products(weights_.data(), rows_); }

 private:
  double* weights(std::size_t row) { return weights_.data() + row * stride_; }
  const double* weights(std::size_t row) const { return weights_.data() + row * stride_; }

  std::size_t rows_ = 0, rows_max_, stride_ = 0;
  std::vector<double> weights_;   // W', row by row, as many as an update has had
  std::vector<double> whitened_;  // y
  // Of the pair tested last: h W, and the innovation and its covariance given the accepted pairs.
  std::array<std::vector<double>, 2> mixed_;
  std::array<double, 2> innovation_{};
  std::array<double, 3> spread_{};
  std::vector<double> scratch_;
};

}  // namespace waitpoint::segloc
