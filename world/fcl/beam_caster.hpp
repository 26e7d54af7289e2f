// SPDX-License-Identifier: BSD-3-Clause
// Casts planar beams in a world with the engine named by its description: by walks of FCL's trees, or by exact slices
// at the heights of the description's sensors. Ranges are the same bits either way.
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
  /// The scenes must outlive it; solids are numbered as there. stand() and move() pass on the shapes of the scenes. The
  /// surfaces are those of the description's meshes.
  BeamCaster(const WorldDescription& description, const Surfaces& surfaces, const Scene& obstacles, Scene& movers);

  /// The scene of obstacles was rebuilt from these shapes.
  void stand(std::span<const Shape> obstacles);
  /// The scene of movers was rebuilt from these shapes.
  void move(std::span<const Shape> movers);
  /// Moves a mover; in the scene of movers, too, but not before the next access.
  void place(std::uint32_t mover, const Outline& outline, double z_low_m, double z_high_m);

  /// Sets the distance of each beam to the first obstacle or mover other than `own` (Scene::none: all count);
  /// range_max_m if none is nearer. As many ranges as directions.
  void cast(const Fan& fan, double height_m, std::uint32_t own, double range_max_m, std::span<double> ranges_m) const;
  /// The same for one beam.
  double cast(Point origin, Point direction, double height_m, std::uint32_t own, double range_max_m) const;

  /// The scene of movers, up to date.
  const Scene& movers() const;
  /// Overwrites `movers` with the numbers of all movers; with slices, neighbours are adjacent.
  void list_movers(std::vector<std::uint32_t>& movers) const;

 private:
  const Slice* slice_at(double height_m) const;

  const Scene& obstacles_;
  MeshTree meshes_;
  Scene& movers_;
  bool slices_beams_;
  std::vector<double> heights_m_;    // of the slices, ascending, all different
  std::vector<Surfaces::Cut> cuts_;  // of the meshes, one per height
  std::vector<Slice> slices_;        // one per height
  MovingSolids moving_;              // empty without slices
  // Movers whose place in the scene is out of date, and a flag per mover. Without access to the scene, as when all
  // sensors use slices, its solids, which are scattered in memory, are never touched.
  mutable std::vector<std::uint32_t> late_;
  mutable std::vector<char> is_late_;

  // Scratch space of one call, kept so that scans allocate nothing.
  mutable DepthBuffer buffer_;
  mutable std::vector<Point> directions_;
};

}  // namespace waitpoint::world
