// SPDX-License-Identifier: BSD-3-Clause
// The module of the mobile base: speaks to its RFLEX controller, by two posters.
//
//   reads    rflex.reading (the controller's reports), and the speed reference's poster (GENPOS_CART_SPEED)
//   writes   rflex.command (to the controller), rflex.odometry, rflex.battery, rflex.sonars
//   requests TrackSpeedStart, GotoSpeed, Stop (each ends the others); SetPos, SonarOn, SonarOff; MonitorBattery
//
// While tracking, a reference that stops being renewed stops the robot: its writer may have died. A base that flies is
// kept at cruise_height_m meanwhile, whatever the reference says of climbing.
#pragma once

#include <optional>

#include "modules/genom/module.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/rflex/dead_reckoning.hpp"

namespace waitpoint::rflex {

/// What can be set of the module.
struct Parameters {
  OdometryNoise noise;
  double units_per_m = 103000, units_per_rad = 35000;  ///< of a B21r's controller
  std::string speed_poster = "ndd.speed";              ///< what TrackSpeedStart tracks
  Duration reference_timeout_ms = std::chrono::milliseconds(500);
  double battery_low_v = 22.5;
  double sonar_ring_radius_m = 0.25;
  double cruise_height_m = 0;  ///< that tracking climbs to and holds; 0: it climbs as the reference says
  double climb_m_s_max = 0.5;  ///< towards it

  static constexpr auto fields() {
    return std::tuple(
        field("noise", &Parameters::noise), field("units_per_m", &Parameters::units_per_m),
        field("units_per_rad", &Parameters::units_per_rad), field("speed_poster", &Parameters::speed_poster),
        field("reference_timeout_ms", &Parameters::reference_timeout_ms),
        field("battery_low_v", &Parameters::battery_low_v),
        field("sonar_ring_radius_m", &Parameters::sonar_ring_radius_m),
        field("cruise_height_m", &Parameters::cruise_height_m), field("climb_m_s_max", &Parameters::climb_m_s_max));
  }
};

/// Input of GotoSpeed.
struct SpeedInput {
  double v_m_s = 0, w_rad_s = 0, side_m_s = 0, climb_m_s = 0;

  static constexpr auto fields() {
    return std::tuple(field("v_m_s", &SpeedInput::v_m_s), field("w_rad_s", &SpeedInput::w_rad_s),
                      added_field("side_m_s", &SpeedInput::side_m_s), added_field("climb_m_s", &SpeedInput::climb_m_s));
  }
};

class Rflex : public genom::Module {
 public:
  explicit Rflex(genom::ModuleSetup& setup);

 private:
  static Parameters read(genom::Settings& settings);
  void set_position(const Pose& pose);
  void take_report();
  void track_reference();
  void drive(double v_m_s, double w_rad_s, double side_m_s, double climb_m_s);

  Parameters parameters_;
  DeadReckoning dead_reckoning_;
  genom::ExecutionTask& motion_;
  genom::PosterLink<posters::BaseReading>& reading_;
  genom::PosterLink<posters::SpeedReference>& reference_;
  posters::BaseCommand command_;
  genom::OutputPoster<posters::BaseCommand>& command_poster_;
  genom::OutputPoster<posters::Odometry>& odometry_;
  genom::OutputPoster<posters::Battery>& battery_poster_;
  genom::OutputPoster<posters::Sonars>& sonars_;
  std::optional<posters::Odometry> shown_;  // by the odometry poster
  posters::Battery battery_;
  std::uint32_t reference_number_ = 0;
  Time reference_renewed_;
};

}  // namespace waitpoint::rflex
