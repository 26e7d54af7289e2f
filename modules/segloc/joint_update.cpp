// SPDX-License-Identifier: BSD-3-Clause
#include "modules/segloc/joint_update.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace waitpoint::segloc {

JointUpdate::JointUpdate(std::size_t pairs) : rows_max_(2 * pairs), whitened_(rows_max_, 0.0) {
  mixed_[0].assign(rows_max_, 0.0);
  mixed_[1].assign(rows_max_, 0.0);
}

void JointUpdate::clear(const Covariance& covariance) {
  rows_ = 0;
  stride_ = covariance.stride();
}

JointUpdate::Trial JointUpdate::test(const Covariance& covariance, const RowPair& pair) {
  const auto& [h0, h1] = pair.derivative;
  double p00 = 0, p01 = 0, p11 = 0;
  for (std::size_t a = 0; a < pair.columns; ++a) {
    double g0 = 0, g1 = 0;
    for (std::size_t b = 0; b < pair.columns; ++b) {
      const double p = covariance(pair.column[a], pair.column[b]);
      g0 += p * h0[b];
      g1 += p * h1[b];
    }
    p00 += h0[a] * g0;
    p01 += h0[a] * g1;
    p11 += h1[a] * g1;
  }
  innovation_ = pair.innovation;
  for (std::size_t r = 0; r < rows_; ++r) {
    const double* w = weights(r);
    double m0 = 0, m1 = 0;
    for (std::size_t a = 0; a < pair.columns; ++a) {
      m0 += h0[a] * w[pair.column[a]];
      m1 += h1[a] * w[pair.column[a]];
    }
    mixed_[0][r] = m0;
    mixed_[1][r] = m1;
    p00 -= m0 * m0;
    p01 -= m0 * m1;
    p11 -= m1 * m1;
    innovation_[0] -= m0 * whitened_[r];
    innovation_[1] -= m1 * whitened_[r];
  }
  const auto& [n00, n01, n11] = pair.noise;
  spread_ = {p00 + n00, p01 + n01, p11 + n11};
  const auto& [s00, s01, s11] = spread_;
  const auto& [v0, v1] = innovation_;
  const double determinant = s00 * s11 - s01 * s01;
  return {(v0 * v0 * s11 - 2.0 * v0 * v1 * s01 + v1 * v1 * s00) / determinant,
          (n11 * p00 - 2.0 * n01 * p01 + n00 * p11) / (n00 * n11 - n01 * n01)};
}

void JointUpdate::accept(const Covariance& covariance, const RowPair& pair) {
  WAITPOINT_CHECK(!full(), "more observations than one update takes");
  const std::size_t size = covariance.size();
  WAITPOINT_CHECK(covariance.stride() == stride_, "the covariance has changed its size during an update");
  weights_.resize(std::max(weights_.size(), (rows_ + 2) * stride_));
  scratch_.resize(std::max(scratch_.size(), stride_));
  double *w0 = weights(rows_), *w1 = weights(rows_ + 1);
  std::fill(w0, w0 + stride_, 0.0);
  std::fill(w1, w1 + stride_, 0.0);
  for (std::size_t a = 0; a < pair.columns; ++a) {
    const double h0 = pair.derivative[0][a], h1 = pair.derivative[1][a];
    covariance.column(pair.column[a], scratch_.data());
    for (std::size_t i = 0; i < size; ++i) {
      w0[i] += scratch_[i] * h0;
      w1[i] += scratch_[i] * h1;
    }
  }
  for (std::size_t r = 0; r < rows_; ++r) {
    const double* w = weights(r);
    const double m0 = mixed_[0][r], m1 = mixed_[1][r];
    for (std::size_t i = 0; i < size; ++i) {
      w0[i] -= w[i] * m0;
      w1[i] -= w[i] * m1;
    }
  }
  const double l00 = std::sqrt(spread_[0]), l10 = spread_[1] / l00;
  const double rest = spread_[2] - l10 * l10;
  WAITPOINT_CHECK(spread_[0] > 0 && rest > 0, "the covariance of an innovation is not positive");
  const double l11 = std::sqrt(rest);
  const double per_l00 = 1.0 / l00, per_l11 = 1.0 / l11;
  for (std::size_t i = 0; i < size; ++i) {
    w0[i] *= per_l00;
    w1[i] = (w1[i] - l10 * w0[i]) * per_l11;
  }
  whitened_[rows_] = innovation_[0] * per_l00;
  whitened_[rows_ + 1] = (innovation_[1] - l10 * whitened_[rows_]) * per_l11;
  rows_ += 2;
}

double JointUpdate::correction(std::size_t i) const {
  double sum = 0;
  for (std::size_t r = 0; r < rows_; ++r) sum += weights(r)[i] * whitened_[r];
  return sum;
}

}  // namespace waitpoint::segloc
