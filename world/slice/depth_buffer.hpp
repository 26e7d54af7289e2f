// SPDX-License-Identifier: BSD-3-Clause
// A planar scan as a one-dimensional depth buffer: the nearest hit so far of each beam.
//
//   begin         sets every range to the limit
//   lower(slice)  walks the slice's tree once, near to far: a rectangle's corners give its interval of beams; an
//                 interval filled by nearer hits is dropped, otherwise the children are visited or the solid is tested
//                 against each beam
//   lower(moving) the same for the tree of the moving solids
//
// Few beams (at most FewBeams::most) walk together, near to far too, each only through the nodes that it meets: they
// are too few for the occlusion test by blocks.
//
// Culling is in floats, with margins; hits are those of hit_distance(), so the ranges equal those of a test of every
// solid, to the last bit, in any order. Buffers are reused: only a scan with more beams than any before allocates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "world/slice/kernels.hpp"
#include "world/slice/moving_solids.hpp"
#include "world/slice/slice.hpp"

namespace waitpoint::world {

/// Beams from one point, counter-clockwise, equally spaced.
struct Fan {
  Point origin;
  Point axis;                         ///< unit vector towards the middle
  double angle_step_rad = 0;          ///< a fan spans at most a full turn
  std::span<const Point> directions;  ///< unit vectors in the frame whose x axis is `axis`; at most 2^20
};

class DepthBuffer {
 public:
  explicit DepthBuffer(const Kernels& of = kernels()) : kernels_(&of) {}

  /// Begins a scan whose beams end at `range_max_m` (may be infinite). With `identify`, solids() is filled, too.
  void begin(const Fan& fan, double range_max_m, bool identify = false);

  void lower(const Slice& slice);
  /// Without solid `except`.
  void lower(const MovingSolids& solids, double height_m, std::uint32_t except = no_solid);

  /// One range per beam: the distance of its nearest hit; range_max_m without a nearer one.
  std::span<const double> ranges_m() const { return {ranges_m_.data(), beams_}; }
  /// One solid per beam: the nearest; of equally near ones the least number; no_solid if none is within range_max_m.
  /// Empty unless the scan was begun with `identify`.
  std::span<const std::uint32_t> solids() const { return {solids_.data(), identify_ ? beams_ : 0}; }

 private:
  struct Pending {
    float near_m2;
    std::int32_t child, first, last;
  };

  /// Narrow candidates are tested at once, batched per node: an occlusion test would take longer, since its branch is
  /// unpredictable.
  /// Intervals of fewer blocks are compared beam by beam: the outer beams may be the only visible ones.
  static constexpr std::int32_t few_blocks = 3;
  static bool is_narrow(const Pending& what) {
    return what.first <= what.last && what.last - what.first < Sight::narrow_beams;
  }

  /// A node and the set of beams that may meet it, a bit per beam.
  struct PendingFew {
    float near_m;
    std::int32_t child;
    std::uint32_t beams;
  };

  /// A solid that the beams may meet; `outline` is null if the solid is excluded.
  struct Candidate {
    const Outline* outline = nullptr;
    std::uint32_t solid = no_solid;
  };

  /// Kernels::look has already tested such narrow candidates for occlusion by whole blocks.
  static bool is_of_two_blocks(const Pending& what) {
    return what.first <= what.last && what.last / Beams::block - what.first / Beams::block <= 1;
  }

  bool is_within(const Pending& what) const;
  View view(Point middle, double extent_m) const;
  bool hidden(const Pending& what) const;
  bool hidden(float near_m2, std::int32_t first, std::int32_t last) const;
  template <class Find, class Place>
  void lower(std::span<const TreeNode> nodes, Point middle, double extent_m, Find find, Place place);
  std::int32_t node_in_reach(std::span<const TreeNode> nodes, const View& from, float reach_m) const;
  template <class Find>
  void walk_few(std::span<const TreeNode> nodes, const View& from, Find find);
  template <class Find, class Place>
  void walk(std::span<const TreeNode> nodes, const View& from, Find find, Place place);
  template <class Find, class Place>
  void push_in_sight(std::span<const TreeNode> nodes, std::size_t node, const View& view, Find find, Place place);
  void ask(const Outline& outline, std::uint32_t solid, const Pending& where);
  void ask_narrow(const Outline& outline, std::uint32_t solid, const Pending& where);
  void ask_each(const Outline& outline, std::uint32_t solid, const Pending& where);
  bool ask_beam(std::size_t beam, const Outline& outline, std::uint32_t solid);
  void note_farthest(std::int32_t block);
  Beams beams();

  const Kernels* kernels_;
  Point origin_, axis_;
  double half_rad_ = 0, per_rad_ = 0;
  double range_max_m_ = 0;
  bool identify_ = false;
  std::size_t beams_ = 0;
  // One per beam; the last is repeated to the end of its block.
  std::vector<double> x_, y_, ranges_m_;
  std::vector<std::uint32_t> solids_;
  std::vector<float> farthest_m2_;  // one per block
  std::vector<Pending> pending_;
  std::vector<PendingFew> pending_few_;
};

}  // namespace waitpoint::world
