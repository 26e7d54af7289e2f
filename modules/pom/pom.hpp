// SPDX-License-Identifier: BSD-3-Clause
// The module of position management: one reference position from several sources of different rates and delays.
//
//   reads    rflex.odometry; optionally segloc.localisation; rflex.gps, if its settings declare a receiver
//   writes   pom.position
//   requests SetPos: the robot's known pose at present. SourceOn, SourceOff: a source joins or leaves the fusion
#pragma once

#include <optional>

#include "modules/genom/module.hpp"
#include "modules/pom/position_fusion.hpp"
#include "modules/posters/inertial.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::pom {

/// Input of SourceOn and SourceOff: 0 is `segloc`, 1 the position receiver.
struct SourceInput {
  std::uint32_t source = 0;

  static void fields(auto field) { field("source", &SourceInput::source); }
};

class Pom : public genom::Module {
 public:
  explicit Pom(genom::ModuleSetup& setup);

 private:
  template <class Parameters>
  static Parameters read(genom::Settings& settings);
  genom::Report set_position(const posters::KnownPose& known);
  void fuse();

  static constexpr std::uint32_t segloc = 0, receiver = 1;

  FusionParameters parameters_;
  FixParameters fix_parameters_;
  genom::ExecutionTask& fusing_;
  genom::PosterLink<posters::Odometry>& odometry_;
  genom::PosterLink<posters::Localisation>& localisation_;
  genom::PosterLink<posters::PositionFix>* gps_;  // null without a receiver
  genom::OutputPoster<posters::FusedPosition>& position_;
  std::optional<PositionFusion> fusion_;  // since the first SetPos
  Time localised_;                        // date of the last localisation used
  std::uint64_t fix_number_ = 0;          // number of the last fix used
};

}  // namespace waitpoint::pom
