// SPDX-License-Identifier: BSD-3-Clause
// A ring of bumper panels, the first in front, counter-clockwise, each for an equal sector of directions.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "core/fields.hpp"

namespace waitpoint::world {

struct Bumpers {
  static constexpr std::string_view key = "bumpers", noun = "the bumpers";
  static constexpr std::uint32_t count_max = 32;

  struct Description {
    std::uint32_t count = 14;
    double travel_m = 0.001;  ///< a panel is pressed by anything nearer

    static void fields(auto field) {
      // Bodies stop short of contact.
      constexpr NumberRange travel{1e-5, 0.1, "a distance from 0.00001 to 0.1 m"};
      field("count", &Description::count, CountRange{1, count_max},
            "panels, the first in front, counter-clockwise; a contact presses the panel that faces it");
      field("travel_m", &Description::travel_m, travel, "distance from the body at which an obstacle presses a panel");
    }
  };

  struct Reading {
    Time date;
    std::uint32_t pressed = 0;  ///< panel i in bit i

    static void fields(auto field) {
      field("date", &Reading::date);
      field("pressed", &Reading::pressed);
    }
  };

  /// That of the base controller's reports.
  static constexpr Duration period(const Description&) { return std::chrono::milliseconds(20); }

  class Model;
};

}  // namespace waitpoint::world
