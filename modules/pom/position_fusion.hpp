// SPDX-License-Identifier: BSD-3-Clause
// The robot's reference position, from dead reckoning and delayed absolute positions.
//
//   T(now) = T(t) (+) (odo(t)^-1 (+) odo(now))
//
//       odometry   .  .  .  .  .  .  .  .  .  .  .  .  now      about every 20 ms, cumulative covariance
//       base       B                                            the oldest state still available
//       corrections     c1       c2      c3                     absolute positions ordered by date
//
// A correction is applied at its own date, whenever it arrives: later-dated ones are applied again. So the result
// depends on the set of inputs, not on their order of arrival, bit for bit. Each correction is fused by a Kalman update
// with the state carried to its date by odometry, unless it contradicts that state (chi square, 3 degrees of freedom):
// then it is excluded, and the state is `disagree` until its source agrees again. Corrections older than the odometry
// buffer are merged into the base. A receiver's fix, a position without heading, is a correction like the others
// (position_fix.hpp).
//
// The design is that of LAAS's `pom`: sources can be added and removed at run time; readers see one position.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "core/fields.hpp"
#include "modules/pom/odometry_buffer.hpp"
#include "modules/pom/position_fix.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::pom {

struct FusionParameters {
  bool kalman = true;
  bool shared_errors = true;
  double gate = 16.27;
  double uncertain_m = 0.3;
  double uncertain_rad = 0.2;
  double motion_covariance_scale = 1;
  double extrapolation_s_max = 0.1;

  static void fields(auto field) {
    field("kalman", &FusionParameters::kalman,
          "Kalman fusion; false: the more certain of state and correction is used alone");
    field("shared_errors", &FusionParameters::shared_errors,
          "sources may share errors with odometry, as those that use it do");
    field("gate", &FusionParameters::gate, "chi square of 3 degrees of freedom at 99.9 %");
    field("uncertain_m", &FusionParameters::uncertain_m, "the state is `uncertain` above this standard deviation");
    field("uncertain_rad", &FusionParameters::uncertain_rad, "or above this one");
    field("motion_covariance_scale", &FusionParameters::motion_covariance_scale, "factor on the odometry's covariance");
    field("extrapolation_s_max", &FusionParameters::extrapolation_s_max,
          "extrapolation of the last motion beyond the newest odometry");
  }
};

class PositionFusion {
 public:
  static constexpr std::uint32_t source_count_max = 8;
  static constexpr std::size_t odometry_count_max = 1024;  ///< 20 s at 50 Hz
  static constexpr std::size_t correction_count_max = 256;

  /// The robot is at `start` in the reference frame at the date of the first odometry.
  PositionFusion(const FusionParameters& parameters, const UncertainPose& start);

  /// Adds a dead-reckoned position in a frame of its own, with cumulative covariance.
  void add_odometry(const posters::PositionEstimate& odometry);

  /// Adds an absolute position from source 0 .. source_count_max - 1; ignored if the source is off. One newer than the
  /// odometry waits until odometry has caught up; one older than the base is too late.
  void add_absolute(std::uint32_t source, const posters::PositionEstimate& position);

  /// The same for a position without a heading and with errors independent of odometry; `gate` is for 2 degrees of
  /// freedom.
  void add_fix(std::uint32_t source, Time date, const PositionFix& fix, double gate);

  /// Sources are initially on. A source switched off leaves the fusion at its next correction, and never disagrees.
  void set_source(std::uint32_t source, bool on);

  /// Restarts from a known position at a date; corrections dated up to it are discarded.
  void reset(Time date, const UncertainPose& position);

  /// The position at a date not before the newest correction, usually the present. Without odometry, the start.
  posters::FusedPosition at(Time now) const;

  /// Number of corrections that came too late, since the start.
  std::uint32_t late() const { return late_; }

 private:
  struct State {
    Time date;
    UncertainPose estimate;
  };
  struct Correction {
    Time date;
    std::uint32_t source;
    std::variant<UncertainPose, PositionFix> measured;
    double gate;
    bool applied, accepted;
    State after;
  };
  void add(const Correction& added);
  UncertainPose corrected(const UncertainPose& predicted, const UncertainPose& measured) const;
  UncertainPose corrected(const UncertainPose& predicted, const PositionFix& measured) const;
  void apply_from(std::size_t first);
  void forget_before(Time date);
  UncertainPose carry(const State& from, Time to, Duration horizon = Duration()) const;
  const State& newest_state() const;

  FusionParameters parameters_;
  OdometryBuffer odometry_;
  State base_;
  std::optional<Time> base_correction_;  // date of the newest accepted correction in the base
  std::vector<Correction> corrections_;  // ordered by (date, source)
  std::array<bool, source_count_max> on_{}, disagrees_in_base_{};
  std::uint32_t late_ = 0;
};

}  // namespace waitpoint::pom
