// SPDX-License-Identifier: BSD-3-Clause
// The module of robots without goals: drives about and turns away from obstacles seen by its range finder. It
// accesses the devices directly, so it is a robot's complete software, for crowds and for worlds without any.
//
//   reads    wander.scan (the range finder's scans); optionally wander.base_reading (the base's reports): a stalled
//            robot backs off
//   writes   wander.laser (to the range finder: on), wander.base (to the base)
//   requests Go, Stop
#pragma once

#include "modules/genom/module.hpp"
#include "modules/wander/way.hpp"

namespace waitpoint::wander {

class Wander : public genom::Module {
 public:
  explicit Wander(genom::ModuleSetup& setup);

 private:
  static Parameters read(genom::Settings& settings);
  void drive();

  Parameters parameters_;
  Way way_;
  genom::ExecutionTask& driving_;
  genom::PosterLink<posters::LaserReading>& scan_;
  genom::PosterLink<posters::BaseReading>& base_reading_;
  posters::LaserCommand laser_command_;
  posters::BaseCommand base_command_;
  genom::OutputPoster<posters::LaserCommand>& laser_;
  genom::OutputPoster<posters::BaseCommand>& base_;
  bool on_;
  posters::LaserReading last_scan_;
  posters::BaseReading report_;
};

}  // namespace waitpoint::wander
