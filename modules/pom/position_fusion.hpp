// SPDX-License-Identifier: BSD-3-Clause
// The robot's reference position, from dead reckoning and absolute positions that come late.
//
//   T(now) = T(t) (+) (odo(t)^-1 (+) odo(now))
//
//       odometry   .  .  .  .  .  .  .  .  .  .  .  .  now      every 20 ms or so, cumulative covariance
//       base       B                                            the oldest state that can still be gone back to
//       corrections     c1       c2      c3                     absolute positions in the order of their dates
//
// A correction is applied at its own date, whenever it arrives: those dated after it are applied again. So the answer
// depends on what has arrived, not on the order in which it did, bit for bit. Each one is fused by a Kalman update with
// the state carried there by odometry, unless it contradicts that state (chi square, 3 degrees of freedom): then it is
// left out, and the fusion says `disagree` until its source agrees again. What falls out of the odometry buffer moves
// into the base. A receiver's fix, which is a position without a heading, is a correction like the others
// (position_fix.hpp).
//
// The design is that of LAAS's `pom`: sources come and go while it runs, readers see one position.
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
  bool kalman = true;                  ///< fuse; false: the more certain of state and correction stands alone
  bool shared_errors = true;           ///< sources may share errors with odometry, as one that went through it does
  double gate = 16.27;                 ///< chi square of 3 degrees of freedom at 99.9 %
  double uncertain_m = 0.3;            ///< the state is `uncertain` above this standard deviation
  double uncertain_rad = 0.2;          ///< or above this one
  double motion_covariance_scale = 1;  ///< how much less odometry is trusted than it says
  double extrapolation_s_max = 0.1;    ///< beyond the newest odometry the last motion is assumed to go on

  static constexpr auto fields() {
    return std::tuple(field("kalman", &FusionParameters::kalman),
                      field("shared_errors", &FusionParameters::shared_errors), field("gate", &FusionParameters::gate),
                      field("uncertain_m", &FusionParameters::uncertain_m),
                      field("uncertain_rad", &FusionParameters::uncertain_rad),
                      field("motion_covariance_scale", &FusionParameters::motion_covariance_scale),
                      field("extrapolation_s_max", &FusionParameters::extrapolation_s_max));
  }
};

class PositionFusion {
 public:
  static constexpr std::uint32_t source_count_max = 8;
  static constexpr std::size_t odometry_count_max = 1024;  ///< 20 s at 50 Hz
  static constexpr std::size_t correction_count_max = 256;

  /// The robot stands at `start` in the reference frame when the first odometry is dated.
  PositionFusion(const FusionParameters& parameters, const UncertainPose& start);

  /// Takes in a dead-reckoned position; its frame is its own, its covariance cumulative.
  void add_odometry(const posters::PositionEstimate& odometry);

  /// Takes in an absolute position from source 0 .. source_count_max - 1; from one that is switched off, it is ignored.
  /// One newer than the odometry is kept until odometry has caught up; one older than the base is too late to count.
  void add_absolute(std::uint32_t source, const posters::PositionEstimate& position);

  /// The same of a position without a heading, which errs independently of odometry; `gate` is that of 2 degrees of
  /// freedom.
  void add_fix(std::uint32_t source, Time date, const PositionFix& fix, double gate);

  /// Sources are on at first. One switched off is out of the fusion from its next correction on, and disagrees no more.
  void set_source(std::uint32_t source, bool on);

  /// Starts over from a known position at a date; corrections dated up to it are forgotten.
  void reset(Time date, const UncertainPose& position);

  /// The position at a date not before the newest correction, usually the present. Without odometry, the start.
  posters::FusedPosition at(Time now) const;

  /// Corrections that came too late to count, since the start.
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
  std::optional<Time> base_correction_;  // the newest accepted correction that moved into the base
  std::vector<Correction> corrections_;  // by (date, source)
  std::array<bool, source_count_max> on_{}, disagrees_in_base_{};
  std::uint32_t late_ = 0;
};

}  // namespace waitpoint::pom
