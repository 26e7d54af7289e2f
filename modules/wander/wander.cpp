// SPDX-License-Identifier: BSD-3-Clause
#include "modules/wander/wander.hpp"

namespace waitpoint::wander {

using genom::Nothing;
using genom::Report;
using namespace std::chrono_literals;

Parameters Wander::read(genom::Settings& settings) {
  Parameters parameters;
  settings.read(parameters);
  return parameters;
}

Wander::Wander(genom::ModuleSetup& setup)
    : Module(setup, 26),
      parameters_(read(setup.settings)),
      way_(parameters_),
      driving_(add_task("driving", {.period_ms = 100ms, .delay_ms = {}, .cost_us = {}})),
      scan_(read_poster<posters::LaserReading>("scan")),
      base_reading_(read_poster<posters::BaseReading>("base_reading", false)),
      laser_(add_poster<posters::LaserCommand>("laser", driving_, &laser_command_)),
      base_(add_poster<posters::BaseCommand>("base", driving_, &base_command_)),
      on_(parameters_.on) {
  driving_.set_permanent([this] { drive(); });
  const auto turn = [this](bool on) {
    return [this, on](const Nothing&, Nothing&) -> Report {
      on_ = on;
      return genom::ok;
    };
  };
  add_control<Nothing>("Go", turn(true));
  add_control<Nothing>("Stop", turn(false));
}

void Wander::drive() {
  laser_command_.on = on_;
  if (on_ && scan_.read(last_scan_) != genom::PosterStatus::empty) {
    const bool reports = base_reading_.read(report_) != genom::PosterStatus::empty;
    way_.decide(last_scan_, reports && report_.stalled, threads::now(), base_command_);
  } else {
    base_command_ = {};
  }
}

}  // namespace waitpoint::wander
