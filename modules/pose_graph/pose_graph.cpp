// SPDX-License-Identifier: BSD-3-Clause
// Eigen's temporaries are on the heap: the stack of a task is small, and they grow with the graph.
#define EIGEN_STACK_ALLOCATION_LIMIT 0

#include "modules/pose_graph/pose_graph.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>

#include "core/error.hpp"

namespace waitpoint::pose_graph {
namespace {

// Cauchy's: about linear where a measurement misses by more than this many deviations.
constexpr double doubt_square = 4;

double robust_cost(double square, bool doubtful) {
  return doubtful ? doubt_square * exact::log(1 + square / doubt_square) : square;
}

double robust_weight(double square, bool doubtful) { return doubtful ? 1 / (1 + square / doubt_square) : 1; }

/// Derivatives of missing() by the two poses, rows of (x, y, heading).
struct Derivatives {
  std::array<std::array<double, 3>, 3> from, to;
};

Derivatives derivatives(const Pose& from, const Pose& to, const Pose& seen) {
  // e = R(-seen) (R(-from) (to - from) - seen)
  const auto [s, c] = exact::sincos(from.heading + seen.heading);
  const double dx = to.x - from.x, dy = to.y - from.y;
  Derivatives d;
  d.to = {{{c, s, 0}, {-s, c, 0}, {0, 0, 1}}};
  d.from = {{{-c, -s, -s * dx + c * dy}, {s, -c, -c * dx - s * dy}, {0, 0, -1}}};
  return d;
}

}  // namespace

std::array<double, 3> missing(const Pose& from, const Pose& to, const Pose& seen) {
  const Pose rest = between(seen, between(from, to));
  return {rest.x, rest.y, rest.heading};
}

double squared_length(const std::array<double, 3>& v, const Matrix3& m) {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += v[i] * (m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2]);
  return sum;
}

std::size_t PoseGraph::add(const Pose& pose) {
  poses_.push_back(pose);
  return poses_.size() - 1;
}

void PoseGraph::measure(const Measurement& measurement) {
  WAITPOINT_CHECK(measurement.from < size() && measurement.to < size() && measurement.from != measurement.to,
                  "a measurement between poses that are not there");
  measurements_.push_back(measurement);
}

double PoseGraph::cost() const {
  double sum = 0;
  for (const Measurement& m : measurements_) {
    sum += robust_cost(squared_length(missing(poses_[m.from], poses_[m.to], m.seen), m.information), m.doubtful);
  }
  return 0.5 * sum;
}

void PoseGraph::optimise(unsigned steps_max) {
  if (size() < 2 || measurements_.empty()) return;
  const auto variables = static_cast<Eigen::Index>(3 * (size() - 1));
  // Its order of elimination is by approximate minimum degree, of integers alone: the same for the same graph.
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
  Eigen::SparseMatrix<double> matrix(variables, variables);
  std::vector<Eigen::Triplet<double>> elements;
  double damping = 0, before = cost();
  for (unsigned step = 0; step < steps_max; ++step) {
    elements.clear();
    Eigen::VectorXd right = Eigen::VectorXd::Zero(variables);
    for (const Measurement& m : measurements_) {
      const auto e = missing(poses_[m.from], poses_[m.to], m.seen);
      const double weight = robust_weight(squared_length(e, m.information), m.doubtful);
      const Derivatives d = derivatives(poses_[m.from], poses_[m.to], m.seen);
      const std::array<const std::array<std::array<double, 3>, 3>*, 2> by = {&d.from, &d.to};
      const std::array<std::size_t, 2> pose = {m.from, m.to};
      for (std::size_t a = 0; a < 2; ++a) {
        if (pose[a] == 0) continue;
        const auto row = static_cast<Eigen::Index>(3 * (pose[a] - 1));
        // (J_a' information), three by three
        std::array<std::array<double, 3>, 3> weighted;
        for (std::size_t i = 0; i < 3; ++i) {
          for (std::size_t k = 0; k < 3; ++k) {
            double sum = 0;
            for (std::size_t r = 0; r < 3; ++r) sum += (*by[a])[r][i] * m.information[3 * r + k];
            weighted[i][k] = weight * sum;
          }
          right[row + static_cast<Eigen::Index>(i)] -=
              weighted[i][0] * e[0] + weighted[i][1] * e[1] + weighted[i][2] * e[2];
        }
        for (std::size_t b = 0; b < 2; ++b) {
          // The lower triangle alone is read.
          if (pose[b] == 0 || pose[b] > pose[a]) continue;
          const auto column = static_cast<Eigen::Index>(3 * (pose[b] - 1));
          for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
              double sum = 0;
              for (std::size_t r = 0; r < 3; ++r) sum += weighted[i][r] * (*by[b])[r][k];
              elements.emplace_back(row + static_cast<Eigen::Index>(i), column + static_cast<Eigen::Index>(k), sum);
            }
          }
        }
      }
    }
    for (Eigen::Index i = 0; i < variables; ++i) elements.emplace_back(i, i, damping + 1e-9);
    matrix.setFromTriplets(elements.begin(), elements.end());
    if (step == 0) solver.analyzePattern(matrix);
    solver.factorize(matrix);
    if (solver.info() != Eigen::Success) return;
    const Eigen::VectorXd change = solver.solve(right);
    const std::vector<Pose> old = poses_;
    for (std::size_t i = 1; i < size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * (i - 1));
      poses_[i] = {poses_[i].x + change[at], poses_[i].y + change[at + 1],
                   exact::wrap_angle(poses_[i].heading + change[at + 2])};
    }
    const double after = cost();
    // A nearly singular matrix gives steps that are no numbers.
    if (!std::isfinite(after) || after > before) {
      poses_ = old;
      damping = damping > 0 ? 10 * damping : 1;
      if (damping > 1e8) return;
      continue;
    }
    damping = damping > 1e-3 ? 0.1 * damping : 0;
    const bool done = before - after <= 1e-4 * before;
    before = after;
    if (done) return;
  }
}

}  // namespace waitpoint::pose_graph
