// SPDX-License-Identifier: BSD-3-Clause
// The mobile base: commands and readings of its controller (the hardware side of `rflex`), and the outputs of `rflex`.
#pragma once

#include "core/fields.hpp"
#include "modules/posters/position.hpp"
#include "world/sensors/types/infrareds.hpp"
#include "world/sensors/types/sonars.hpp"

namespace waitpoint::posters {

/// To the controller: speeds to hold until the next command. Bases without sideways motion (to the left) or climbing
/// ignore these.
struct BaseCommand {
  double v_m_s = 0, w_rad_s = 0;
  bool sonars_on = false;
  double side_m_s = 0, climb_m_s = 0;

  static void fields(auto field) {
    field("v_m_s", &BaseCommand::v_m_s);
    field("w_rad_s", &BaseCommand::w_rad_s);
    field("sonars_on", &BaseCommand::sonars_on);
    field("side_m_s", &BaseCommand::side_m_s, added);
    field("climb_m_s", &BaseCommand::climb_m_s, added);
  }
};

/// From the controller: its report at `date`. Travel and turn are accumulated and quantised in the controller's own
/// units (RFLEX: about 103 000 per metre and 35 000 per radian on a B21r).
struct BaseReading {
  Time date;
  std::int64_t travel_units = 0, turn_units = 0;
  double v_m_s = 0, w_rad_s = 0;
  double battery_volts = 0;
  bool stalled = false;
  Bounded<double, world::Sonars::count_max> sonar_m;  ///< ring by ring; no echo: the greatest range; empty while off
  std::int64_t side_units = 0;                        ///< as travel, to the left; bases with sideways motion
  double height_m = 0;                                ///< flying bases
  double battery_charge = 0, battery_a = 0;           ///< remaining fraction; current; if the battery is simulated

  static void fields(auto field) {
    field("date", &BaseReading::date);
    field("travel_units", &BaseReading::travel_units);
    field("turn_units", &BaseReading::turn_units);
    field("v_m_s", &BaseReading::v_m_s);
    field("w_rad_s", &BaseReading::w_rad_s);
    field("battery_volts", &BaseReading::battery_volts);
    field("stalled", &BaseReading::stalled);
    field("sonar_m", &BaseReading::sonar_m);
    field("side_units", &BaseReading::side_units, added);
    field("height_m", &BaseReading::height_m, added);
    field("battery_charge", &BaseReading::battery_charge, added);
    field("battery_a", &BaseReading::battery_a, added);
  }
};

/// The speed requested by a motion module, tracked by `rflex` (the LAAS name of this poster is GENPOS_CART_SPEED, that
/// of the sideways speed there vt).
struct SpeedReference {
  Time date;
  double v_m_s = 0, w_rad_s = 0;
  std::uint32_t number = 0;  ///< counts the references: if it does not change, the writer has stopped
  double side_m_s = 0, climb_m_s = 0;

  static void fields(auto field) {
    field("date", &SpeedReference::date);
    field("v_m_s", &SpeedReference::v_m_s);
    field("w_rad_s", &SpeedReference::w_rad_s);
    field("number", &SpeedReference::number);
    field("side_m_s", &SpeedReference::side_m_s, added);
    field("climb_m_s", &SpeedReference::climb_m_s, added);
  }
};

struct Battery {
  Time date;
  double volts = 0;
  bool low = false;
  double charge = 0, current_a = 0;  ///< remaining fraction; current; if the battery is simulated

  static void fields(auto field) {
    field("date", &Battery::date);
    field("volts", &Battery::volts);
    field("low", &Battery::low);
    field("charge", &Battery::charge, added);
    field("current_a", &Battery::current_a, added);
  }
};

/// The last range of a sonar or infrared range finder, with the device's pose in the robot's frame.
struct SonarEcho {
  Pose mount;
  double range_m = 0;

  static void fields(auto field) {
    field("mount", &SonarEcho::mount);
    field("range_m", &SonarEcho::range_m);
  }
};

struct Sonars {
  Time date;
  Bounded<SonarEcho, world::Sonars::count_max> echoes;

  static void fields(auto field) {
    field("date", &Sonars::date);
    field("echoes", &Sonars::echoes);
  }
};

struct Infrareds {
  Time date;
  Bounded<SonarEcho, world::Infrareds::count_max> echoes;

  static void fields(auto field) {
    field("date", &Infrareds::date);
    field("echoes", &Infrareds::echoes);
  }
};

}  // namespace waitpoint::posters
