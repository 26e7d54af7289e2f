// SPDX-License-Identifier: BSD-3-Clause
// The module of the mobile base: the driver of its RFLEX controller, through two posters.
//
//   reads    rflex.reading (the controller's reports), and the speed reference's poster (GENPOS_CART_SPEED);
//            rflex.bumper_reading, rflex.infrared_reading, rflex.imu_reading, rflex.gps_reading (other ports of the
//            controller), where the robot has them
//   writes   rflex.command (to the controller), rflex.odometry, rflex.battery, rflex.sonars, rflex.bumpers,
//            rflex.infrareds, rflex.imu, rflex.gps
//   requests TrackSpeedStart, GotoSpeed, Stop (each ends the others); SetPos, SonarOn, SonarOff, InfraredOn,
//            InfraredOff; MonitorBattery, MonitorBumpers (end when it is low, when one is pressed); CalibrateGyro
//            (fails if the robot moves, or has no gyro)
//
// While tracking, the robot stops if the reference is not renewed: its writer may have failed. A flying base is kept at
// cruise_height_m meanwhile, and the reference's climb speed is ignored.
#pragma once

#include <optional>

#include "modules/genom/module.hpp"
#include "modules/posters/base.hpp"
#include "modules/posters/navigation.hpp"
#include "modules/rflex/dead_reckoning.hpp"
#include "modules/rflex/echoes.hpp"
#include "modules/rflex/gyro_turn.hpp"
#include "world/sensors/types/bumpers.hpp"
#include "world/sensors/types/gps.hpp"

namespace waitpoint::rflex {

/// Parameters of the module.
struct Parameters {
  OdometryNoise noise;
  double units_per_m = 103000, units_per_rad = 35000;
  std::string speed_poster = "ndd.speed";
  Duration reference_timeout_ms = std::chrono::milliseconds(500);
  double battery_low_v = 22.5, battery_low_charge = 0;
  double sonar_ring_radius_m = 0.25;
  double cruise_height_m = 0;
  double climb_m_s_max = 0.5;
  Bounded<SonarRing, 4> sonar_rings;
  InfraredCalibration infrared;
  bool gyro_turns = false;
  Duration gyro_calibration_ms = std::chrono::seconds(5);

  static void fields(auto field) {
    field("noise", &Parameters::noise, "growth of the uncertainty of dead reckoning");
    field("units_per_m", &Parameters::units_per_m, "counts of the controller, by default of a B21r's");
    field("units_per_rad", &Parameters::units_per_rad, "the same of turns");
    field("speed_poster", &Parameters::speed_poster, "poster with the reference of the request TrackSpeedStart");
    field("reference_timeout_ms", &Parameters::reference_timeout_ms,
          "the base stops when the reference is older than this");
    field("battery_low_v", &Parameters::battery_low_v, "the battery is low below this voltage,");
    field("sonar_ring_radius_m", &Parameters::sonar_ring_radius_m, "of a single ring of sonars");
    field("cruise_height_m", &Parameters::cruise_height_m,
          "height that an aerial robot holds while it tracks; 0: the reference has its climb speed");
    field("climb_m_s_max", &Parameters::climb_m_s_max, "towards cruise_height_m");
    field("sonar_rings", &Parameters::sonar_rings,
          "rings of sonars, if there are several; sonars beyond their count are ignored");
    field("infrared", &Parameters::infrared, "calibration of the infrared range finders");
    field("battery_low_charge", &Parameters::battery_low_charge, "or below this charge, from 0 to 1");
    field("gyro_turns", &Parameters::gyro_turns, "the odometry has its turns from the gyro, which the robot must have");
    field("gyro_calibration_ms", &Parameters::gyro_calibration_ms, "time at rest in which the gyro is calibrated");
  }
};

using posters::SpeedInput;

/// Failures of CalibrateGyro, other than interruption.
enum class CalibrationReport : std::uint16_t { no_gyro = genom::first_own_report, moved };

/// Output of CalibrateGyro.
struct GyroBias {
  double rad_s = 0;

  static void fields(auto field) { field("rad_s", &GyroBias::rad_s); }
};

class Rflex : public genom::Module {
 public:
  explicit Rflex(genom::ModuleSetup& setup);

 private:
  static Parameters read(genom::Settings& settings);
  void set_position(const Pose& pose);
  void take_report();
  void show_sonars(const posters::BaseReading& report);
  void take_bumpers();
  void take_infrareds();
  void take_motion_sensors();
  void add_motions();
  void add_switches();
  void add_calibration();
  void track_reference();
  void drive(double v_m_s, double w_rad_s, double side_m_s, double climb_m_s);

  Parameters parameters_;
  DeadReckoning dead_reckoning_;
  genom::ExecutionTask& motion_;
  genom::PosterLink<posters::BaseReading>& reading_;
  genom::PosterLink<posters::SpeedReference>& reference_;
  genom::PosterLink<world::Bumpers::Reading>& bumper_reading_;
  genom::PosterLink<world::Infrareds::Reading>& infrared_reading_;
  genom::PosterLink<world::Imu::Reading>& imu_reading_;
  genom::PosterLink<world::Gps::Reading>& gps_reading_;
  posters::BaseCommand command_;
  genom::OutputPoster<posters::BaseCommand>& command_poster_;
  genom::OutputPoster<posters::Odometry>& odometry_;
  genom::OutputPoster<posters::Battery>& battery_poster_;
  genom::OutputPoster<posters::Sonars>& sonars_;
  genom::OutputPoster<world::Bumpers::Reading>& bumpers_poster_;
  genom::OutputPoster<posters::Infrareds>& infrareds_poster_;
  genom::OutputPoster<world::Imu::Reading>& imu_poster_;
  genom::OutputPoster<world::Gps::Reading>& gps_poster_;
  std::optional<posters::Odometry> shown_;  // value of the odometry poster
  posters::Battery battery_;
  world::Bumpers::Reading bumpers_;
  bool infrared_on_ = false;
  GyroTurn gyro_;
  std::uint64_t fix_number_ = 0;
  Time calibration_began_;
  posters::BaseReading report_, calibration_report_;
  std::uint32_t reference_number_ = 0;
  Time reference_renewed_;
};

}  // namespace waitpoint::rflex
