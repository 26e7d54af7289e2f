// SPDX-License-Identifier: BSD-3-Clause
// Localisation errors of a robot: its posters compared with the true state, observed from outside the run.
//
// Observation makes no event: the run is the same with and without it. Each position is compared with the true one at
// its own date. Paths are given to whom asked for them; nothing is kept here.
#pragma once

#include "core/working_set.hpp"
#include "modules/bridge/path.hpp"
#include "modules/bridge/run_result.hpp"
#include "modules/genom/name_space.hpp"
#include "modules/posters/odometry_trail.hpp"
#include "modules/posters/position.hpp"
#include "world/world.hpp"

namespace waitpoint::bridge {

class alignas(64) Evaluation {
 public:
  /// Finds the posters of `pom`'s position and `rflex`'s odometry; a missing one is not evaluated.
  void connect(const genom::NameSpace& names);

  /// Call after each step of the world; `now` is the time of the step.
  void observe(Time now, const world::BodyState& truth);

  /// Before the first observe(): `sink`, which must outlive the last one, receives the paths.
  void add_path_sink(PathSink& sink) { path_sinks_.push_back(&sink); }

  /// Adds the memory that every observe() touches.
  void add_to(WorkingSet& set) const;

  /// Maximum error of the fused position so far.
  double position_error_max_m() const { return fused_error_max_m_; }
  /// Writes the errors to the result.
  void write(RobotResult& result) const;

 private:
  void sample(PathKind kind, Time date, const Pose& pose);

  // First the members that a step touches even without a position.
  std::vector<PathSink*> path_sinks_;
  const genom::Poster<posters::FusedPosition>* fused_ = nullptr;
  const genom::Poster<posters::Odometry>* odometry_ = nullptr;
  posters::OdometryTrail truth_;
  Time fused_date_, odometry_date_;
  std::uint64_t fused_count_ = 0;
  double fused_error_sum_m_ = 0, fused_error_max_m_ = 0;
  double odometry_error_max_m_ = 0, odometry_error_m_ = 0;
  PerPath<std::optional<Time>> sampled_;  // dates of the last samples
};

}  // namespace waitpoint::bridge
