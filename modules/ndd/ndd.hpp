// SPDX-License-Identifier: BSD-3-Clause
// The module of reactive navigation by the nearness diagram.
//
//   reads    sick.echoes, rflex.odometry, pom.position
//   writes   ndd.speed (the reference that rflex tracks)
//   requests GoTo: follow via points; the last is the goal. Ends with `ok` at rest there, or with the report `blocked`.
//            A new GoTo replaces the previous one; Stop ends it.
//            Reroute: other via points for the active GoTo, without a halt
#pragma once

#include "modules/genom/module.hpp"
#include "modules/ndd/navigator.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/followed_route.hpp"
#include "modules/posters/laser.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/posters/position.hpp"

namespace waitpoint::ndd {

class Ndd : public genom::Module, public posters::FollowedRoute {
 public:
  explicit Ndd(genom::ModuleSetup& setup);

  std::span<const Point> route_ahead() const override { return navigator_.route().ahead(); }

 private:
  static Parameters read(genom::Settings& settings);
  void perceive();
  genom::State go(const posters::GoToInput& input);
  void reference(const Speeds& speeds);

  Navigator navigator_;
  genom::ExecutionTask& motion_;
  genom::PosterLink<posters::Echoes>& echoes_;
  genom::PosterLink<posters::Odometry>& odometry_;
  genom::PosterLink<posters::FusedPosition>& position_poster_;
  genom::OutputPoster<posters::SpeedReference>& speed_;
  posters::Echoes scan_;
  posters::FusedPosition position_;
  bool located_ = false;
  std::uint32_t references_ = 0;
};

}  // namespace waitpoint::ndd
