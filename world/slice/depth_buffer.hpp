// SPDX-License-Identifier: BSD-3-Clause
// A planar scan as a depth buffer of one dimension: for each beam the nearest hit so far.
//
//   begin        every range is the limit
//   lower(slice) one walk of its tree, near to far: a rectangle's corners give its interval of beams; where nearer hits
//                already fill that, it is dropped, else its children are looked at, or the solid is asked about each
//                beam
//   lower(moving) the same for the tree of those that move
//
// A few beams walk together, near to far too, each only where it meets a node: they have no blocks to be hidden by.
//
// Floats cull, with margins; hits are those of hit_distance(), so the ranges are those of asking every solid, to the
// last bit, in whatever order. A buffer is used again and again: only a scan of more beams than any before allocates.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "world/slice/kernels.hpp"
#include "world/slice/moving_solids.hpp"
#include "world/slice/slice.hpp"

namespace waitpoint::world {

/// Beams from one point, counter-clockwise, at equal angles.
struct Fan {
  Point origin;
  Point axis;                         ///< unit vector towards the middle
  double angle_step_rad = 0;          ///< a fan spans at most a full turn
  std::span<const Point> directions;  ///< unit vectors in the frame whose x axis is `axis`; at most 2^20
};

class DepthBuffer {
 public:
  explicit DepthBuffer(const Kernels& of = kernels()) : kernels_(&of) {}

  /// A new scan of beams that end at `range_max_m` (which may be infinite). `identify`: solids are wanted, too.
  void begin(const Fan& fan, double range_max_m, bool identify = false);

  void lower(const Slice& slice);
  /// Without the solid numbered `except`.
  void lower(const MovingSolids& solids, double height_m, std::uint32_t except = no_solid);

  /// The distance of each beam to what it hits; range_max_m where that is not nearer.
  std::span<const double> ranges_m() const { return {ranges_m_.data(), beams_}; }
  /// What each beam hits: of equally near solids the one of the least number; no_solid if nothing within range_max_m.
  /// Only of a scan that identifies.
  std::span<const std::uint32_t> solids() const { return {solids_.data(), identify_ ? beams_ : 0}; }

 private:
  struct Pending {
    float near_m2;
    std::int32_t child, first, last;
  };

  /// What is so narrow is asked about as soon as it is seen, together with what else of its node is: to look whether it
  /// is hidden would take longer, for it cannot be foreseen.
  static constexpr std::int32_t narrow_beams = 16;
  /// Within so few blocks beams are looked at one by one: those at the ends may be all that is not hidden.
  static constexpr std::int32_t few_blocks = 3;
  static bool is_narrow(const Pending& what) {
    return what.first <= what.last && what.last - what.first < narrow_beams;
  }

  /// A node, and which of a few beams may meet it.
  struct PendingFew {
    float near_m;
    std::int32_t child;
    std::uint32_t beams;
  };

  /// A solid that the beams may meet; none for one that does not count.
  struct Candidate {
    const Outline* outline = nullptr;
    std::uint32_t solid = no_solid;
  };

  /// What is so narrow, and hidden by whole blocks, is not in view.
  static bool is_of_two_blocks(const Pending& what) {
    return what.first <= what.last && what.last / Beams::block - what.first / Beams::block <= 1;
  }

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
  // Of each beam; the last is repeated to the end of its block.
  std::vector<double> x_, y_, ranges_m_;
  std::vector<std::uint32_t> solids_;
  std::vector<float> farthest_m2_;  // of each block
  std::vector<Pending> pending_;
  std::vector<PendingFew> pending_few_;
};

}  // namespace waitpoint::world
