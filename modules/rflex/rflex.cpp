// SPDX-License-Identifier: BSD-3-Clause
#include "modules/rflex/rflex.hpp"

#include <algorithm>
#include <cmath>

namespace waitpoint::rflex {

using genom::Nothing;
using genom::Report;
using genom::State;
using namespace std::chrono_literals;

namespace {
constexpr double height_time_s = 0.5;  // time constant of the height control

void check(const InfraredCalibration& of) {
  if (!(of.gain_per_v > 0)) throw BadInput("infrared.gain_per_v", "expected more than 0");
  if (!(of.exponent < 0)) throw BadInput("infrared.exponent", "expected less than 0");
}

}  // namespace

Parameters Rflex::read(genom::Settings& settings) {
  Parameters parameters;
  settings.read(parameters);
  settings.check_not_negative(parameters.noise, "noise.");
  constexpr double units_least = 1e-3;
  settings.check_least("units_per_m", parameters.units_per_m, units_least);
  settings.check_least("units_per_rad", parameters.units_per_rad, units_least);
  check(parameters.infrared);
  return parameters;
}

Rflex::Rflex(genom::ModuleSetup& setup)
    : Module(setup, 21),
      parameters_(read(setup.settings)),
      dead_reckoning_(parameters_.noise, parameters_.units_per_m, parameters_.units_per_rad),
      motion_(add_task("motion", {.period_ms = 20ms, .delay_ms = {}, .cost_us = 100us})),
      reading_(read_poster<posters::BaseReading>("reading")),
      reference_(read_poster<posters::SpeedReference>(parameters_.speed_poster, false)),
      bumper_reading_(read_poster<world::Bumpers::Reading>("bumper_reading", false)),
      infrared_reading_(read_poster<world::Infrareds::Reading>("infrared_reading", false)),
      imu_reading_(read_poster<world::Imu::Reading>("imu_reading", parameters_.gyro_turns)),
      gps_reading_(read_poster<world::Gps::Reading>("gps_reading", false)),
      command_poster_(add_poster<posters::BaseCommand>("command", motion_, &command_)),
      odometry_(add_poster<posters::Odometry>("odometry", motion_)),
      battery_poster_(add_poster<posters::Battery>("battery", motion_)),
      sonars_(add_poster<posters::Sonars>("sonars", motion_)),
      bumpers_poster_(add_poster<world::Bumpers::Reading>("bumpers", motion_)),
      infrareds_poster_(add_poster<posters::Infrareds>("infrareds", motion_)),
      imu_poster_(add_poster<world::Imu::Reading>("imu", motion_)),
      gps_poster_(add_poster<world::Gps::Reading>("gps", motion_)) {
  motion_.set_permanent([this] {
    take_motion_sensors();
    take_report();
    take_bumpers();
    take_infrareds();
  });
  add_motions();
  add_activity<Nothing, posters::Battery>("MonitorBattery", motion_, {.exec = [this](auto& activity) {
                                            activity.output = battery_;
                                            return battery_.low ? State::ether : State::exec;
                                          }});
  add_control<posters::KnownPose>("SetPos", [this](const posters::KnownPose& input, Nothing&) {
    set_position(input.pose);
    return genom::ok;
  });
  add_switches();
  add_activity<Nothing, world::Bumpers::Reading>("MonitorBumpers", motion_, {.exec = [this](auto& activity) {
                                                   activity.output = bumpers_;
                                                   return bumpers_.pressed != 0 ? State::ether : State::exec;
                                                 }});
  add_calibration();
}

void Rflex::add_motions() {
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
}

void Rflex::add_switches() {
  const auto switched = [](bool& what, bool on) {
    return [&what, on](const Nothing&, Nothing&) -> Report {
      what = on;
      return genom::ok;
    };
  };
  add_control<Nothing>("SonarOn", switched(command_.sonars_on, true));
  add_control<Nothing>("SonarOff", switched(command_.sonars_on, false));
  add_control<Nothing>("InfraredOn", switched(infrared_on_, true));
  add_control<Nothing>("InfraredOff", switched(infrared_on_, false));
}

void Rflex::add_calibration() {
  const auto moved = [this] {
    return report_.travel_units != calibration_report_.travel_units ||
           report_.turn_units != calibration_report_.turn_units || report_.side_units != calibration_report_.side_units;
  };
  add_activity<Nothing, GyroBias>(
      "CalibrateGyro", motion_,
      {.start =
           [this](auto& activity) {
             if (gyro_.corrected().number == 0) {
               activity.report = own_report(static_cast<std::uint16_t>(CalibrationReport::no_gyro));
               return State::ether;
             }
             calibration_began_ = threads::now();
             calibration_report_ = report_;
             gyro_.begin_calibration();
             return State::exec;
           },
       .exec =
           [this, moved](auto& activity) {
             if (moved()) {
               activity.report = own_report(static_cast<std::uint16_t>(CalibrationReport::moved));
               return State::ether;
             }
             if (threads::now() - calibration_began_ < parameters_.gyro_calibration_ms) return State::exec;
             activity.output.rad_s = gyro_.end_calibration();
             return State::ether;
           }},
      {"CalibrateGyro"});
}

// Readers of the new position must not find odometry in the previous frame.
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
  report_ = report;
  const double gyro_units = gyro_.corrected().turned_rad * parameters_.units_per_rad;
  const std::int64_t turn_units =
      parameters_.gyro_turns ? static_cast<std::int64_t>(std::nearbyint(gyro_units)) : report.turn_units;
  dead_reckoning_.advance(report.date, report.travel_units, turn_units, report.side_units);
  shown_ = {dead_reckoning_.position(), report.v_m_s, report.w_rad_s, report.stalled, report.height_m};
  odometry_.write(*shown_);
  const bool low = report.battery_volts < parameters_.battery_low_v ||
                   (report.battery_charge > 0 && report.battery_charge < parameters_.battery_low_charge);
  battery_ = {report.date, report.battery_volts, low, report.battery_charge, report.battery_a};
  battery_poster_.write(battery_);
  if (!report.sonar_m.empty()) show_sonars(report);
}

void Rflex::show_sonars(const posters::BaseReading& report) {
  Bounded<SonarRing, 4> rings = parameters_.sonar_rings;
  if (rings.empty())
    rings.push_back({static_cast<std::uint32_t>(report.sonar_m.size()), parameters_.sonar_ring_radius_m});
  sonars_.write(sonar_echoes(report, {rings.begin(), rings.size()}));
}

void Rflex::take_bumpers() {
  world::Bumpers::Reading reading;
  if (bumper_reading_.read(reading) == genom::PosterStatus::empty) return;
  bumpers_ = reading;
  bumpers_poster_.write(bumpers_);
}

void Rflex::take_infrareds() {
  world::Infrareds::Reading reading;
  if (!infrared_on_ || infrared_reading_.read(reading) == genom::PosterStatus::empty) return;
  infrareds_poster_.write(infrared_echoes(reading, parameters_.infrared));
}

void Rflex::take_motion_sensors() {
  world::Imu::Reading sample;
  if (imu_reading_.read(sample) != genom::PosterStatus::empty && sample.number != gyro_.corrected().number) {
    gyro_.add(sample);
    imu_poster_.write(gyro_.corrected());
  }
  world::Gps::Reading fix;
  if (gps_reading_.read(fix) != genom::PosterStatus::empty && fix.number != fix_number_) {
    fix_number_ = fix.number;
    gps_poster_.write(fix);
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
