// SPDX-License-Identifier: BSD-3-Clause
// Rings of sonars, which the base's controller fires and reports.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/exact_math.hpp"
#include "core/fields.hpp"

namespace waitpoint::world {

/// A ring of sonars on a cylinder about the body's centre, the first straight ahead, counter-clockwise. The ring is
/// divided into banks of neighbours, each with one firing member at a time: all members 0 at once, then all members 1,
/// for example.
struct SonarRingDescription {
  std::uint32_t count = 24;  ///< 0: none
  double ring_radius_m = 0.25, height_m = 0.6;
  double half_cone_rad = 0.218;  ///< a wall gives an echo only if its normal is inside
  double range_min_m = 0.15, range_max_m = 3;
  double range_noise_relative = 0.01;
  Duration period = std::chrono::milliseconds(120);  ///< of a full ring
  std::vector<std::uint32_t> firing_order;  ///< the members of a bank in the order of their turns; empty: all at once
  bool crosstalk = false;                   ///< sonars that fire at once hear each other
  double air_celsius = 20, calibrated_celsius = 20;  ///< true, and assumed in the computation of ranges

  static void fields(auto field) {
    using D = SonarRingDescription;
    constexpr NumberRange cone{least_nonzero, 90, "degrees above 0, at most 90"};
    constexpr NumberRange celsius{-60, 60, "degrees from -60 to 60"};
    field("count", &D::count, CountRange{1, 48}, "the first points straight ahead; counter-clockwise");
    field("ring_radius_m", &D::ring_radius_m, ranges::length_error, "of the ring");
    field("height_m", &D::height_m, ranges::height, "with the robot on the floor");
    field("half_cone_deg", &D::half_cone_rad, degrees, cone, "half the opening angle of the cone");
    field("range_min_m", &D::range_min_m, ranges::length_error, "the least range");
    field("range_max_m", &D::range_max_m, ranges::length, "without an echo the reading is the greatest range");
    field("range_noise_relative", &D::range_noise_relative, ranges::rate_error,
          "standard deviation, relative to the range");
    field("period_ms", &D::period, "each fires once in it; each turn must be long enough for its echoes");
    field("crosstalk", &D::crosstalk,
          "simultaneously fired sonars hear each other's single reflections, between rings of one order too");
    field("air_celsius", &D::air_celsius, celsius, "the speed of sound is 331.3 + 0.606 T m/s");
    field("calibrated_celsius", &D::calibrated_celsius, celsius, "ranges are computed for this temperature");
  }
};

struct Sonars {
  static constexpr std::string_view key = "sonars", noun = "a ring of sonars";
  static constexpr std::string_view device = "sonar";
  static constexpr bool several = true, in_turns = true, switched_by_base = true;
  static constexpr std::uint32_t count_max = 48;  ///< of all rings of a body

  using Description = SonarRingDescription;

  /// Of one ring. A firing measures those transducers whose turn it is, the others keep their ranges.
  struct Reading {
    Time date;
    std::uint64_t number = 0;            ///< of firings so far; 0: none yet
    Bounded<double, count_max> range_m;  ///< without an echo the greatest range

    static void fields(auto field) {
      field("date", &Reading::date);
      field("number", &Reading::number);
      field("range_m", &Reading::range_m);
    }
  };

  /// Firings in one round of a ring.
  static constexpr std::uint64_t turns(const Description& of) {
    return of.firing_order.empty() ? 1 : of.firing_order.size();
  }
  /// True if a transducer fires in the firing of that number, from 0.
  static bool fires(const Description& of, std::uint32_t transducer, std::uint64_t firing) {
    const std::uint64_t all = turns(of);
    WAITPOINT_FAST_CHECK(all == 1 || of.firing_order[firing % all] < all, "a ring's order names no member of a bank");
    return all == 1 || transducer % all == of.firing_order[firing % all];
  }
  /// The transducer's pose in the body's frame.
  static Pose mount(const Description& of, std::uint32_t transducer) {
    const double heading = exact::wrap_angle(2 * exact::pi * transducer / of.count);
    const auto [s, c] = exact::sincos(heading);
    return {of.ring_radius_m * c, of.ring_radius_m * s, heading};
  }
  static constexpr Duration period(const Description& of) { return of.period / static_cast<std::int64_t>(turns(of)); }

  static std::optional<std::string> contradiction(const Description& of) {
    return of.range_max_m <= of.range_min_m ? std::optional("expected range_max_m to be above range_min_m")
                                            : std::nullopt;
  }
};

}  // namespace waitpoint::world
