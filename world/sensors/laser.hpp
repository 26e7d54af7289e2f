// SPDX-License-Identifier: BSD-3-Clause
// The error model of a scanning laser with a mirror, such as the SICK LMS:
//
//   time       each beam is measured at its own time, from the device's pose then (world/sensors/laser_timing.hpp)
//   direction  has an error
//   echo       a spot on two surfaces far apart reads a range between them (a mixed pixel), uniformly distributed; flat
//              incidence gives no echo; some echoes are lost
//   range      r = q(d + b + b_w e^(-t/T) + s(d) n): a bias, a decaying warm-up bias, noise that grows with the range,
//              quantisation
//
// The data sheet gives the standard deviation s up to 8 m, and twice that at 20 m; it is taken as linear between, and
// constant beyond. Mixed pixels, warming up and the effect of incidence after Ye and Borenstein, "Characterization of a
// 2-D laser scanner for mobile robot obstacle negotiation", ICRA 2002. A spot is three rays: its middle and two ends.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/random.hpp"
#include "world/description.hpp"
#include "world/sensors/arc_trail.hpp"
#include "world/sensors/ray_caster.hpp"

namespace waitpoint::world {

/// The standard deviation of a range.
double range_noise_m(const LaserDescription& laser, double range_m);

/// The data shared by all lasers with equal descriptions, so that a crowd's lasers read it from memory once.
struct LaserKind {
  explicit LaserKind(const LaserDescription& of);

  LaserDescription description;
  bool plain;                              ///< the beams are equally spaced lines from one point, at one instant
  double first_angle_rad, angle_step_rad;  ///< between neighbouring beams; 0 for a single one
  std::vector<Point> directions;           ///< of the beams in the device's frame, counter-clockwise; unit vectors
};

/// A cache of kinds.
class LaserKinds {
 public:
  /// A recently used kind, or a new one.
  std::shared_ptr<const LaserKind> of(const LaserDescription& description);

 private:
  std::deque<std::shared_ptr<const LaserKind>> latest_;
};

class Laser {
 public:
  /// Draws from the streams (seed, robot, "laser <number>.range", and likewise ".angle", ".mixed", ".dropout"), at
  /// tick = number of the scan, index = beam.
  Laser(std::shared_ptr<const LaserKind> kind, std::uint64_t seed, std::string_view robot, std::size_t number);
  /// The only one of its kind.
  Laser(const LaserDescription& description, std::uint64_t seed, std::string_view robot, std::size_t number)
      : Laser(std::make_shared<LaserKind>(description), seed, robot, number) {}

  /// Draws from the streams of this seed from now on.
  void reseed(std::uint64_t seed, std::string_view robot, std::size_t number) { draws_ = Draws(seed, robot, number); }

  const LaserDescription& description() const { return kind_->description; }
  double first_angle_rad() const { return kind_->first_angle_rad; }
  /// Between neighbouring beams; 0 for a single one.
  double angle_step_rad() const { return kind_->angle_step_rad; }
  /// The unit vectors of the beams in the device's frame, counter-clockwise.
  std::span<const Point> directions() const { return kind_->directions; }

  /// True if the beams are equally spaced lines from one point, at one instant: casting a fan then equals look().
  bool plain() const { return kind_->plain; }
  /// Sets the true range of each beam of a scan that has just ended, along the body's recent path; range_max_m without
  /// echo. As many ranges as beams.
  void look(std::uint64_t scan_number, const ArcTrail& body, const RayCaster& caster, std::span<double> ranges_m) const;

  /// Turns true ranges into measured ones, in place, `on_s` after the device was switched on. A true range of at least
  /// range_max_m has no echo; measured ranges are clamped to [0, range_max_m].
  void measure(std::uint64_t scan_number, double on_s, std::span<double> ranges_m) const;

 private:
  struct Draws {
    RandomStream range_noise, angle_noise, mixed, dropout;

    Draws(std::uint64_t seed, std::string_view robot, std::size_t number);
  };

  double seen_m(std::uint64_t scan_number, std::size_t beam, const Ray& middle, const RayCaster& caster) const;

  std::shared_ptr<const LaserKind> kind_;
  Draws draws_;
};

}  // namespace waitpoint::world
