// SPDX-License-Identifier: BSD-3-Clause
// A graph of poses and of measurements between them, and the poses that explain all measurements best.
//
// Each measurement is a pose seen from another one, with the information (the inverse covariance) of its x, y and
// heading. The optimum is found by Gauss-Newton steps on the sparse normal equations, damped where a step would not
// improve. A measurement that may be wrong, a loop closure, has Cauchy's robust weight: the others overrule it.
//
// Sources: Lu, Milios, "Globally consistent range scan alignment for environment mapping", 1997; Konolige, Grisetti,
// Kuemmerle, Burgard, Limketkai, Vincent, "Efficient sparse pose adjustment for 2D mapping", IROS 2010.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/error.hpp"
#include "core/pose.hpp"

namespace waitpoint::pose_graph {

/// Symmetric, in row order, of (x, y, heading).
using Matrix3 = std::array<double, 9>;

struct Measurement {
  std::size_t from = 0, to = 0;  ///< poses, by number
  Pose seen;                     ///< `to` in the frame of `from`
  Matrix3 information{};
  bool doubtful = false;  ///< has the robust weight
};

class PoseGraph {
 public:
  /// The number of the new pose, counted from 0. Pose 0 is fixed.
  std::size_t add(const Pose& pose);
  void measure(const Measurement& measurement);
  /// Another guess of a pose, from which optimise() begins.
  void place(std::size_t pose, const Pose& guess) { poses_[pose] = guess; }

  std::size_t size() const { return poses_.size(); }
  const Pose& operator[](std::size_t pose) const {
    WAITPOINT_CHECK(pose < size(), "a pose that is not in the graph");
    return poses_[pose];
  }
  const std::vector<Measurement>& measurements() const { return measurements_; }

  /// Half the weighted sum of squares of the measurements' residuals.
  double cost() const;
  /// At most so many steps; ends before if the cost hardly falls.
  void optimise(unsigned steps_max);

 private:
  std::vector<Pose> poses_;
  std::vector<Measurement> measurements_;
};

/// The residual of a measurement at two poses: (x, y, heading) of the pose seen, in the frame of the measured one.
std::array<double, 3> missing(const Pose& from, const Pose& to, const Pose& seen);
/// v' m v
double squared_length(const std::array<double, 3>& v, const Matrix3& m);

}  // namespace waitpoint::pose_graph
