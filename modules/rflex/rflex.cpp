// SPDX-License-Identifier: BSD-3-Clause
#include "modules/rflex/rflex.hpp"

#include <algorithm>

namespace waitpoint::rflex {

using genom::Nothing;
using genom::Report;
using genom::State;
using namespace std::chrono_literals;

namespace {
constexpr double height_time_s = 0.5;  // in which a small error of height is to a third of it
}  // namespace

Parameters Rflex::read(genom::Settings& settings) {
  Parameters parameters;
  settings.read(parameters);
  return parameters;
}

Rflex::Rflex(genom::ModuleSetup& setup)
    : Module(setup, 21),
      parameters_(read(setup.settings)),
      dead_reckoning_(parameters_.noise, parameters_.units_per_m, parameters_.units_per_rad),
      motion_(add_task("motion", {.period_ms = 20ms, .delay_ms = {}, .cost_us = 100us})),
      reading_(read_poster<posters::BaseReading>("reading")),
      reference_(read_poster<posters::SpeedReference>(parameters_.speed_poster, false)),
      command_poster_(add_poster<posters::BaseCommand>("command", motion_, &command_)),
      odometry_(add_poster<posters::Odometry>("odometry", motion_)),
      battery_poster_(add_poster<posters::Battery>("battery", motion_)),
      sonars_(add_poster<posters::Sonars>("sonars", motion_)) {
  motion_.set_permanent([this] { take_report(); });
  const std::vector<std::string> motions = {"TrackSpeedStart", "GotoSpeed", "Stop"};
  const auto halt = [this](auto&) {
    drive(0, 0, 0, 0);
    return State::ether;
  };
  add_activity<Nothing>("TrackSpeedStart", motion_,
                        {.start =
                             [this](auto&) {
                               reference_renewed_ = threads::now();
                               return State::exec;
                             },
                         .exec =
                             [this](auto&) {
                               track_reference();
                               return State::exec;
                             },
                         .inter = halt},
                        motions);
  add_activity<SpeedInput>("GotoSpeed", motion_,
                           {.exec =
                                [this](auto& activity) {
                                  const SpeedInput& wanted = activity.input;
                                  drive(wanted.v_m_s, wanted.w_rad_s, wanted.side_m_s, wanted.climb_m_s);
                                  return State::exec;
                                },
                            .inter = halt},
                           motions);
  add_activity<Nothing>("Stop", motion_, {.exec = halt}, motions);
  add_activity<Nothing, posters::Battery>("MonitorBattery", motion_, {.exec = [this](auto& activity) {
                                            activity.output = battery_;
                                            return battery_.low ? State::ether : State::exec;
                                          }});
  add_control<posters::KnownPose>("SetPos", [this](const posters::KnownPose& input, Nothing&) {
    set_position(input.pose);
    return genom::ok;
  });
  const auto switch_sonars = [this](bool on) {
    return [this, on](const Nothing&, Nothing&) -> Report {
      command_.sonars_on = on;
      return genom::ok;
    };
  };
  add_control<Nothing>("SonarOn", switch_sonars(true));
  add_control<Nothing>("SonarOff", switch_sonars(false));
}

// Who is told next where the robot is must not find odometry of the frame before.
void Rflex::set_position(const Pose& pose) {
  dead_reckoning_.set(pose);
  if (!shown_) return;
  shown_->position = dead_reckoning_.position();
  odometry_.write(*shown_);
  odometry_.give();
}

void Rflex::take_report() {
  posters::BaseReading report;
  if (reading_.read(report) == genom::PosterStatus::empty) return;
  dead_reckoning_.advance(report.date, report.travel_units, report.turn_units, report.side_units);
  shown_ = {dead_reckoning_.position(), report.v_m_s, report.w_rad_s, report.stalled, report.height_m};
  odometry_.write(*shown_);
  battery_ = {report.date, report.battery_volts, report.battery_volts < parameters_.battery_low_v};
  battery_poster_.write(battery_);
  if (!report.sonar_m.empty()) {
    posters::Sonars sonars;
    sonars.date = report.date;
    for (std::size_t i = 0; i < report.sonar_m.size(); ++i) {
      const double bearing = 2 * exact::pi * static_cast<double>(i) / static_cast<double>(report.sonar_m.size());
      const auto [s, c] = exact::sincos(bearing);
      const double r = parameters_.sonar_ring_radius_m;
      sonars.echoes.push_back({{r * c, r * s, exact::wrap_angle(bearing)}, report.sonar_m[i]});
    }
    sonars_.write(sonars);
  }
}

void Rflex::track_reference() {
  posters::SpeedReference reference;
  if (reference_.read(reference) == genom::PosterStatus::empty) return;
  const Time now = threads::now();
  if (reference.number != reference_number_) {
    reference_number_ = reference.number;
    reference_renewed_ = now;
  }
  const bool stale = now - reference_renewed_ > parameters_.reference_timeout_ms;
  if (stale) reference = {};
  double climb = reference.climb_m_s;
  if (parameters_.cruise_height_m > 0 && shown_) {
    const double higher = parameters_.cruise_height_m - shown_->height_m;
    climb = std::clamp(higher / height_time_s, -parameters_.climb_m_s_max, parameters_.climb_m_s_max);
  }
  drive(reference.v_m_s, reference.w_rad_s, reference.side_m_s, climb);
}

void Rflex::drive(double v_m_s, double w_rad_s, double side_m_s, double climb_m_s) {
  command_.v_m_s = v_m_s;
  command_.w_rad_s = w_rad_s;
  command_.side_m_s = side_m_s;
  command_.climb_m_s = climb_m_s;
}

}  // namespace waitpoint::rflex
