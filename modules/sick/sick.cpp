// SPDX-License-Identifier: BSD-3-Clause
#include "modules/sick/sick.hpp"

namespace waitpoint::sick {

using genom::Nothing;
using genom::Report;
using genom::State;
using namespace std::chrono_literals;

Parameters Sick::read(genom::Settings& settings) {
  Parameters parameters;
  settings.read(parameters);
  settings.check_not_negative(parameters.segments, "segments.");
  return parameters;
}

Sick::Sick(genom::ModuleSetup& setup)
    : Module(setup, 22),
      parameters_(read(setup.settings)),
      extraction_(parameters_.segments),
      scanning_(add_task("scanning", {.period_ms = 20ms, .delay_ms = {}, .cost_us = {}})),
      reading_(read_poster<posters::LaserReading>("reading")),
      command_poster_(add_poster<posters::LaserCommand>("command", scanning_, &command_)),
      echoes_poster_(add_poster<posters::Echoes>("echoes", scanning_)),
      segments_poster_(add_poster<posters::Segments>("segments", scanning_)) {
  echoes_.mount = {parameters_.mount_x_m, parameters_.mount_y_m, parameters_.mount_heading_deg * (exact::pi / 180)};
  auto& shot = add_activity<Nothing>("ContinuousShot", scanning_,
                                     {.start =
                                          [this](auto&) {
                                            command_.on = true;
                                            return State::exec;
                                          },
                                      .exec =
                                          [this](auto&) {
                                            export_scan();
                                            return State::exec;
                                          },
                                      .inter =
                                          [this](auto&) {
                                            command_.on = false;
                                            return State::ether;
                                          }},
                                     {"ContinuousShot"});
  shot.cost = 500us;
  setup.settings.read_described("shot_cost_us", shot.cost, "cost of a codel of the request ContinuousShot");
  add_control<Nothing>("Stop", [](const Nothing&, Nothing&) { return genom::ok; }, {"ContinuousShot"});
  const auto switch_segments = [this](bool on) {
    return [this, on](const Nothing&, Nothing&) -> Report {
      with_segments_ = on;
      return genom::ok;
    };
  };
  add_control<Nothing>("SegmentsOn", switch_segments(true));
  add_control<Nothing>("SegmentsOff", switch_segments(false));
}

void Sick::export_scan() {
  if (reading_.read(echoes_.scan) == genom::PosterStatus::empty || echoes_.scan.number == number_) return;
  number_ = echoes_.scan.number;
  echoes_.scan.date = echoes_.scan.date - parameters_.scan_age_ms;
  echoes_poster_.write(echoes_);
  if (!with_segments_) return;
  extraction_.extract(echoes_, segments_);
  segments_poster_.write(segments_);
}

}  // namespace waitpoint::sick
