// SPDX-License-Identifier: BSD-3-Clause
#include "modules/ndd/ndd.hpp"

namespace waitpoint::ndd {

using genom::Nothing;
using genom::State;
using posters::GoToInput;
using posters::NavigationReport;
using namespace std::chrono_literals;

Parameters Ndd::read(genom::Settings& settings) {
  Parameters parameters;
  settings.read(parameters);
  settings.check_not_negative(parameters);
  return parameters;
}

Ndd::Ndd(genom::ModuleSetup& setup)
    : Module(setup, 25),
      navigator_(read(setup.settings)),
      motion_(add_task("motion", {.period_ms = 100ms, .delay_ms = 20ms, .cost_us = 200us})),
      echoes_(read_poster<posters::Echoes>("sick.echoes")),
      odometry_(read_poster<posters::Odometry>("rflex.odometry")),
      position_poster_(read_poster<posters::FusedPosition>("pom.position")),
      speed_(add_poster<posters::SpeedReference>("speed", motion_)) {
  motion_.set_permanent([this] { perceive(); });
  auto& go_to = add_activity<GoToInput>(
      "GoTo", motion_,
      {.control =
           [this](const GoToInput& input) {
             return input.via.empty() ? report(genom::StandardReport::control_codel_error) : genom::ok;
           },
       .start =
           [this](auto& activity) {
             if (!located_) {
               activity.report = own_report(static_cast<std::uint16_t>(NavigationReport::no_position));
               return State::ether;
             }
             return go(activity.input);
           },
       .exec =
           [this](auto& activity) {
             const Decision decision = navigator_.decide(threads::now(), position_.position);
             reference(decision.speeds);
             if (decision.outcome == RouteState::driving) return State::exec;
             if (decision.outcome == RouteState::blocked)
               activity.report = own_report(static_cast<std::uint16_t>(NavigationReport::blocked));
             return State::ether;
           },
       .inter =
           [this](auto&) {
             navigator_.stop();
             reference({});
             return State::ether;
           }},
      {"GoTo"});
  go_to.cost = 2ms;
  setup.settings.read_described("goto_cost_us", go_to.cost, "cost of a codel of the request GoTo");
  add_control<Nothing>("Stop", [](const Nothing&, Nothing&) { return genom::ok; }, {"GoTo"});
  add_control<GoToInput>("Reroute", [this](const GoToInput& input, Nothing&) {
    if (input.via.empty()) return report(genom::StandardReport::control_codel_error);
    const bool is_driving = navigator_.reroute(position_.position, {input.via.begin(), input.via.size()});
    return is_driving ? genom::ok : own_report(static_cast<std::uint16_t>(NavigationReport::not_driving));
  });
}

void Ndd::perceive() {
  posters::Odometry odometry;
  if (odometry_.read(odometry) == genom::PosterStatus::ok) navigator_.add_odometry(odometry);
  if (echoes_.read(scan_) == genom::PosterStatus::ok) navigator_.add_echoes(scan_);
  located_ |= position_poster_.read(position_) == genom::PosterStatus::ok;
}

State Ndd::go(const GoToInput& input) {
  navigator_.go(threads::now(), position_.position, {input.via.begin(), input.via.size()});
  return State::exec;
}

void Ndd::reference(const Speeds& speeds) {
  speed_.write({threads::now(), speeds.v_m_s, speeds.w_rad_s, ++references_});
}

}  // namespace waitpoint::ndd
