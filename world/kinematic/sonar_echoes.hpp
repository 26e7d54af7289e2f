// SPDX-License-Identifier: BSD-3-Clause
// The echoes of a body's sonars in a world: the nearest possible echo whose path is free.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "world/fcl/beam_caster.hpp"
#include "world/fcl/scene.hpp"
#include "world/mesh/surfaces.hpp"
#include "world/sensors/sonar_crosstalk.hpp"
#include "world/sensors/surface_corners.hpp"
#include "world/vehicles/vehicle.hpp"

namespace waitpoint::world {

class SonarEchoes {
 public:
  /// The scene, the surfaces and the caster (with the bodies) must outlive it, and be updated before it.
  SonarEchoes(const Scene& obstacles, const Surfaces& surfaces, const BeamCaster& caster);

  /// Finds the concave corners of the obstacles, which must be those of the scene; none before the first call.
  void stand(std::span<const Shape> obstacles);

  /// Fires the transducers of the ring that are due in this firing: sets the distance (m) of each one's echo, infinite
  /// without echo, and keeps the others'. As many distances as transducers.
  void fire(const Vehicle& body, std::uint32_t own, std::size_t ring, std::uint64_t firing,
            std::span<double> distances_m) const;

 private:
  /// A concave corner between an obstacle and `other`.
  struct Corner {
    ConcaveCorner corner;
    std::uint32_t other;
  };

  void collect_surroundings(Point at, double height_m, std::uint32_t own, const SonarRingDescription& ring) const;
  double nearest_echo(const SonarCone& cone, double height_m, std::uint32_t own) const;
  double nearest_cross_echo(const SonarCone& listener, const SonarCone& emitter, double height_m, std::uint32_t own,
                            double below_m) const;
  bool clear(Point from, Point to, double height_m, std::uint32_t own) const;

  const Scene& obstacles_;
  const Surfaces& surfaces_;
  const BeamCaster& caster_;
  std::vector<std::vector<Corner>> corners_;  // per obstacle: with obstacles of greater numbers

  // Scratch space of one call, kept so that firing allocates nothing.
  mutable std::vector<std::uint32_t> near_, near_bodies_;
  mutable std::vector<Outline> near_segments_;
  mutable SurfaceCorners near_corners_;
  mutable std::vector<Echo> echoes_;
  mutable std::vector<CrossEcho> cross_echoes_;
  mutable std::vector<SonarCone> emitters_;
};

}  // namespace waitpoint::world
