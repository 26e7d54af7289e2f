// SPDX-License-Identifier: BSD-3-Clause
// The module of position management: one reference position from several sources of different rates and delays.
//
//   reads    rflex.odometry; optionally segloc.localisation, locate.localisation; rflex.gps, if its settings declare a
//   receiver writes   pom.position
//            While a localisation is lost, pom goes on by odometry; when it has been found anew, pom starts again
//            from it.
//   requests SetPos: the robot's known pose at present. SourceOn, SourceOff: a source joins or leaves the fusion
#pragma once

#include <array>
#include <optional>

#include "modules/genom/module.hpp"
#include "modules/pom/position_fusion.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/position.hpp"
#include "world/sensors/types/gps.hpp"

namespace waitpoint::pom {

/// Input of SourceOn and SourceOff: 0 is `segloc`, 1 the position receiver, 2 `locate`.
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

  static constexpr std::uint32_t segloc = 0, receiver = 1, locate = 2;

  /// A module of localisation, and its last position used.
  struct Source {
    std::uint32_t number;
    genom::PosterLink<posters::Localisation>& poster;
    Time date;
    std::uint32_t jumps = 0;
  };

  FusionParameters parameters_;
  FixParameters fix_parameters_;
  genom::ExecutionTask& fusing_;
  genom::PosterLink<posters::Odometry>& odometry_;
  std::array<Source, 2> localisations_;
  genom::PosterLink<world::Gps::Reading>* gps_;  // null without a receiver
  genom::OutputPoster<posters::FusedPosition>& position_;
  std::optional<PositionFusion> fusion_;  // since the first SetPos
  std::uint64_t fix_number_ = 0;          // number of the last fix used
};

}  // namespace waitpoint::pom
