// SPDX-License-Identifier: BSD-3-Clause
// What the sonars of a body hear in a world: of all that would answer, the nearest that nothing hides.
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
  /// The scene, the surfaces and the caster, which has the bodies, must outlive it, and be told of changes before it
  /// is.
  SonarEchoes(const Scene& obstacles, const Surfaces& surfaces, const BeamCaster& caster);

  /// Finds the corners of the obstacles, which are those of the scene. Without it there are none.
  void stand(std::span<const Shape> obstacles);

  /// Fires the transducers of the body's ring whose turn it is: of each the distance of its echo, infinite if there is
  /// none. The others' distances are left. As many distances as transducers.
  void fire(const Vehicle& body, std::uint32_t own, std::size_t ring, std::uint64_t firing,
            std::span<double> distances_m) const;

 private:
  /// A concave corner of an obstacle with another one.
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
  std::vector<std::vector<Corner>> corners_;  // of each obstacle with later ones

  // Of one call, kept so that firing allocates nothing.
  mutable std::vector<std::uint32_t> near_, near_bodies_;
  mutable std::vector<Outline> near_segments_;
  mutable SurfaceCorners near_corners_;
  mutable std::vector<Echo> echoes_;
  mutable std::vector<CrossEcho> cross_echoes_;
  mutable std::vector<SonarCone> emitters_;
};

}  // namespace waitpoint::world
