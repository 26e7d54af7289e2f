// SPDX-License-Identifier: BSD-3-Clause
// A battery pack and its loads, see vehicles/battery.hpp.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "core/fields.hpp"

namespace waitpoint::world {

struct Battery {
  static constexpr std::string_view key = "battery", noun = "the battery";
  static constexpr bool built_in = true;

  struct Description {
    double volts_full = 26, volts_empty = 22;  ///< without load
    double resistance_ohm = 0.05;
    double resolution_v = 0;  ///< of the reported voltage; 0: continuous
    double capacity_ah = 40;  ///< when discharged in rated_h
    double rated_h = 20;
    double peukert = 1.15;                                                  ///< 1: the same capacity at every current
    double charge = 1;                                                      ///< at the start, of capacity_ah
    double off_v = 0;                                                       ///< cut-off: below this the loads are off
    double idle_a = 4;                                                      ///< always drawn
    double drive_a_per_m_s = 6, turn_a_per_rad_s = 2, climb_a_per_m_s = 0;  ///< drawn by motion; descending: nothing
    double stalled_a = 0;                                                   ///< drawn by motors stalled at a contact

    static void fields(auto field) {
      using D = Description;
      constexpr NumberRange volts{0, 1e5, "a number of volts from 0 to 100000"};
      constexpr NumberRange electrical{0, 1e6, "a number from 0 to 1000000"};
      constexpr NumberRange capacity{1e-6, 1e6, "a number from 0.000001 to 1000000"};
      constexpr NumberRange exponent{1, 2, "a number from 1 to 2"};
      constexpr NumberRange part{least_nonzero, 1, "a part above 0, at most 1"};
      field("volts_full", &D::volts_full, volts, "without load; linear in the charge between full and empty");
      field("volts_empty", &D::volts_empty, volts, "without load");
      field("resistance_ohm", &D::resistance_ohm, electrical, "internal resistance");
      field("resolution_v", &D::resolution_v, ranges::resolution, "steps of the reported voltage; 0: none");
      field("capacity_ah", &D::capacity_ah, capacity, "C, for a discharge in H hours");
      field("rated_h", &D::rated_h, capacity, "H");
      field("peukert", &D::peukert, exponent, "k");
      field("charge", &D::charge, part, "at the start, as a fraction of the capacity");
      field("off_v", &D::off_v, volts, "the battery also counts as empty below this voltage");
      field("idle_a", &D::idle_a, electrical, "constant current");
      field("drive_a_per_m_s", &D::drive_a_per_m_s, electrical, "additional current of motion");
      field("turn_a_per_rad_s", &D::turn_a_per_rad_s, electrical, "additional current of turns");
      field("climb_a_per_m_s", &D::climb_a_per_m_s, electrical, "additional current of climbing; sinking takes none");
      field("stalled_a", &D::stalled_a, electrical, "additional current of stalled motors");
    }
  };

  struct Reading {
    Time date = {};
    double volts = 0, current_a = 0;
    double charge = 1;  ///< remaining fraction of the capacity
    bool empty = false;
    Duration empty_after = {};  ///< from the start; 0 until it is empty: then the loads are off

    static void fields(auto field) {
      field("date", &Reading::date);
      field("volts", &Reading::volts);
      field("current_a", &Reading::current_a);
      field("charge", &Reading::charge);
      field("empty", &Reading::empty);
      field("empty_after_s", &Reading::empty_after);
    }
  };

  static constexpr Duration period(const Description&) { return std::chrono::seconds(1); }

  static std::optional<std::string> contradiction(const Description& of) {
    return of.volts_empty > of.volts_full ? std::optional("expected volts_empty to be at most volts_full")
                                          : std::nullopt;
  }
};

}  // namespace waitpoint::world
