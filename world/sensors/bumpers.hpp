// SPDX-License-Identifier: BSD-3-Clause
// A bumper: panels about a body, each pressed by contacts from its sector of directions.
#pragma once

#include <cstdint>
#include <string_view>

#include "world/sensors/surroundings.hpp"
#include "world/sensors/types/bumpers.hpp"

namespace waitpoint::world {

/// The bit of the panel pressed by an outline at `separation` from a body of that heading; 0 if it is too far away.
std::uint32_t pressed_panel(const Bumpers::Description& bumper, double heading_rad, const Separation& separation);

class Bumpers::Model {
 public:
  Model(const Description& description, std::uint64_t, std::string_view) : description_(description) {}

  void reseed(std::uint64_t, std::string_view) {}
  void read(const Surroundings& surroundings, std::uint64_t number, Reading& reading) const;

 private:
  Description description_;
};

}  // namespace waitpoint::world
