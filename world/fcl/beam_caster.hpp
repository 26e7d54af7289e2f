// SPDX-License-Identifier: BSD-3-Clause
// What planar beams hit of a world, found by the engine that its description names: by walks of FCL's trees, or by
// exact slices where a sensor of the description has its height. Ranges are the same bits either way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "world/description.hpp"
#include "world/fcl/mesh_tree.hpp"
#include "world/fcl/scene.hpp"
#include "world/mesh/surfaces.hpp"
#include "world/slice/depth_buffer.hpp"

namespace waitpoint::world {

class BeamCaster {
 public:
  /// The scenes must outlive it; solids are numbered as there. What they were made of, stand() and move() tell. The
  /// surfaces are those of the description's meshes.
  BeamCaster(const WorldDescription& description, const Surfaces& surfaces, const Scene& obstacles, Scene& movers);

  /// Tells it what the scene of obstacles was made of (anew).
  void stand(std::span<const Shape> obstacles);
  /// Tells it what the scene of movers was made of (anew).
  void move(std::span<const Shape> movers);
  /// Moves one of the movers, in their scene too, once that is asked for.
  void place(std::uint32_t mover, const Outline& outline, double z_low_m, double z_high_m);

  /// The distance of each beam to the first obstacle, or mover other than `own` (Scene::none: all count); range_max_m
  /// where none is nearer. As many ranges as directions.
  void cast(const Fan& fan, double height_m, std::uint32_t own, double range_max_m, std::span<double> ranges_m) const;
  /// The same for one beam.
  double cast(Point origin, Point direction, double height_m, std::uint32_t own, double range_max_m) const;

  /// The movers' scene, with all where they are.
  const Scene& movers() const;
  /// Overwrites `movers` with all of them, neighbours one after the other if there are slices.
  void list_movers(std::vector<std::uint32_t>& movers) const;

 private:
  const Slice* slice_at(double height_m) const;

  const Scene& obstacles_;
  MeshTree meshes_;
  Scene& movers_;
  bool slices_beams_;
  std::vector<double> heights_m_;    // at which there are slices: all different
  std::vector<Surfaces::Cut> cuts_;  // of the meshes, at each
  std::vector<Slice> slices_;
  MovingSolids moving_;  // none without slices
  // Movers that are not yet in the scene where they are, and of each whether it is among them: where all sensors go by
  // slices nobody asks for the scene, and its solids are scattered in memory.
  mutable std::vector<std::uint32_t> late_;
  mutable std::vector<char> is_late_;

  // Of one call, kept so that scans allocate nothing.
  mutable DepthBuffer buffer_;
  mutable std::vector<Point> directions_;
};

}  // namespace waitpoint::world
