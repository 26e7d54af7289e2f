// SPDX-License-Identifier: BSD-3-Clause
// The flow of the floor's image in a camera that looks down: the lens moves by d over the floor, at the height h above
// it,
//
//   counts += c s d / h + n       whole counts are read; the rest stays for the next reading
//
// with c counts for a radian, the scale s and normal noise n. A turn about the lens's own axis gives no flow (the image
// turns in place), a turn about the body's centre moves the lens. Counters have 16 bits. A reading is lost where the
// mean flow of its period is too fast, the lens too near to the floor, or the floor without texture; what moved then is
// lost.
#pragma once

#include <cstdint>
#include <string_view>

#include "core/random.hpp"
#include "world/sensors/surroundings.hpp"
#include "world/sensors/types/optical_flow.hpp"

namespace waitpoint::world {

class OpticalFlow::Model {
 public:
  /// Draws from the streams (seed, robot, "optical_flow.noise") and (.., "optical_flow.dropout"), at tick = number of
  /// the reading, index = axis.
  Model(const Description& description, std::uint64_t seed, std::string_view robot);

  void reseed(std::uint64_t seed, std::string_view robot);
  void moved(const StepDone& step, const BodyState& body);
  const Reading& reading() const { return reading_; }

 private:
  /// Whole counts of the sum, which keeps the rest.
  static std::int32_t take_counts(double& sum);
  void read();

  Description description_;
  RandomStream noise_, dropout_;
  Point flow_rad_;      // since the last reading, in the lens's frame
  Point counts_;        // not read yet
  double floor_m_ = 0;  // the least height of the lens since the last reading
  Duration elapsed_;    // since the last reading
  Reading reading_;
};

}  // namespace waitpoint::world
