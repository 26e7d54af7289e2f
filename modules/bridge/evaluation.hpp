// SPDX-License-Identifier: BSD-3-Clause
// How well a robot knows where it is: its posters against the truth, looked at from outside the run.
//
// Looking makes no event: a run is the same whether it is evaluated or not. A position is compared with the truth at
// its own date.
#pragma once

#include "fibers/kernel/fetch.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/genom/name_space.hpp"
#include "modules/posters/odometry_trail.hpp"
#include "modules/posters/position.hpp"
#include "world/world.hpp"

namespace waitpoint::bridge {

class alignas(64) Evaluation {
 public:
  /// Finds `pom`'s position and `rflex`'s odometry; one that does not exist is not evaluated.
  void connect(const genom::NameSpace& names);

  /// After a step of the world, at `now`.
  void observe(Time now, const world::BodyState& truth);

  /// Ask for the memory that observe() touches: its own and, when that is there, where it will write.
  void fetch_itself() const { kernel::fetch(this); }
  void fetch_path() const { kernel::fetch(true_path_.data() + true_path_.size()); }

  /// Of the fused position, so far.
  double position_error_max_m() const { return fused_error_max_m_; }
  /// Writes errors and paths.
  void write(RobotResult& result) const;

 private:
  void sample(std::vector<DatedPose>& path, Time date, const Pose& pose);

  // What a step touches of a robot that says nothing of where it is comes first.
  std::vector<DatedPose> true_path_;
  const genom::Poster<posters::FusedPosition>* fused_ = nullptr;
  const genom::Poster<posters::Odometry>* odometry_ = nullptr;
  posters::OdometryTrail truth_;
  Time fused_date_, odometry_date_;
  std::uint64_t fused_count_ = 0;
  double fused_error_sum_m_ = 0, fused_error_max_m_ = 0;
  double odometry_error_max_m_ = 0, odometry_error_m_ = 0;
  std::vector<DatedPose> fused_path_, odometry_path_;
};

}  // namespace waitpoint::bridge
