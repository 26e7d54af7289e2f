// SPDX-License-Identifier: BSD-3-Clause
// A battery pack in discharge: its voltage falls with the charge drawn and sags with the current.
//
//   I = idle + a |v| + b |w| + c climb (+ stalled)      U = full - (full - empty) q / C - R I
//   dq = I (I H / C)^(k - 1) dt
//
// C is the capacity when discharged in the rated time of H hours, k Peukert's exponent (W. Peukert, ETZ 20, 1897): at a
// constant current the full pack is empty after H (C / (I H))^k hours. The open-circuit voltage of lead-acid cells is
// about linear in the charge. The pack is empty, for good, when C is drawn or when U falls below the cut-off voltage.
#pragma once

#include "world/arc.hpp"
#include "world/description.hpp"

namespace waitpoint::world {

class BatteryPack {
 public:
  explicit BatteryPack(const Battery::Description& description);

  /// Supplies a body of that velocity in the step of length `step` that ends at `now` since the start.
  void draw(Duration now, Duration step, const Velocity& velocity, bool stalled);
  bool empty() const { return empty_at_.has_value(); }
  Battery::Reading reading() const;

 private:
  double volts() const;

  Battery::Description description_;
  double drawn_ah_, current_a_;
  std::optional<Duration> empty_at_;
};

}  // namespace waitpoint::world
