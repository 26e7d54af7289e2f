// SPDX-License-Identifier: BSD-3-Clause
// The module of position management: one reference position out of several of different rates and delays.
//
//   reads    rflex.odometry; segloc.localisation, which may be absent
//   writes   pom.position
//   requests SetPos: the robot is known to be somewhere, now. SourceOn, SourceOff: a source joins or leaves the fusion
#pragma once

#include <optional>

#include "modules/genom/module.hpp"
#include "modules/pom/position_fusion.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::pom {

/// Input of SourceOn and SourceOff: 0 is `segloc`.
struct SourceInput {
  std::uint32_t source = 0;

  static constexpr auto fields() { return std::tuple(field("source", &SourceInput::source)); }
};

class Pom : public genom::Module {
 public:
  explicit Pom(genom::ModuleSetup& setup);

 private:
  static FusionParameters read(genom::Settings& settings);
  genom::Report set_position(const posters::KnownPose& known);
  void fuse();

  static constexpr std::uint32_t segloc = 0;

  FusionParameters parameters_;
  genom::ExecutionTask& fusing_;
  genom::PosterLink<posters::Odometry>& odometry_;
  genom::PosterLink<posters::Localisation>& localisation_;
  genom::OutputPoster<posters::FusedPosition>& position_;
  std::optional<PositionFusion> fusion_;  // from the first SetPos on
  Time localised_;                        // date of the last localisation taken in
};

}  // namespace waitpoint::pom
