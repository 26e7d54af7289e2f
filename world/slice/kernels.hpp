// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of scans and neighbour searches, in the widest vector instructions of this processor.
//
// All variants give the same bits: `look`, `all_nearer`, `all_end_nearer`, `overlap` and `meet` only cull; the others
// compute hit_distance() with the same operations in the same order (sums, products, quotients and square roots are
// correctly rounded in every width), so a beam alone and the same beam within a fan agree.
#pragma once

#include <cstdint>
#include <vector>

#include "world/planar/outline.hpp"
#include "world/slice/tree.hpp"

namespace waitpoint::world {

/// In place of a solid's number: no hit.
inline constexpr std::uint32_t no_solid = 0xFFFFFFFFu;

/// The beams of a scan, processed in blocks of eight. The arrays are padded to whole blocks, and beyond them by the
/// lengths below, which kernels may read.
struct Beams {
  static constexpr int block = 8;
  static constexpr int blocks_read_beyond = 8, beams_read_beyond = 8;
  Point origin;
  const double *x, *y;      ///< unit directions, one per beam
  double* range_m;          ///< per beam: the nearest hit so far, or the limit
  float* farthest_m2;       ///< per block: an upper bound of its squared ranges
  std::uint32_t* solid_of;  ///< per beam: the solid hit; null unless the scan identifies
};

/// A fan of beams, in floats, for the visibility test of eight rectangles.
struct View {
  float low_x, low_y, high_x, high_y;  ///< the origin, rounded down and up with a margin
  float axis_x, axis_y;                ///< unit vector to the middle of the fan
  float half_rad;                      ///< from the axis to the last beam
  float per_rad;                       ///< beams per radian
  std::int32_t beams;
  float reach_m2;            ///< finite
  const float* farthest_m2;  ///< Beams::farthest_m2
};

/// A rectangle in floats, in a tree's coordinates.
struct FloatBounds {
  float low_x, low_y, high_x, high_y;
};

/// A view's result for eight rectangles: the least squared distance and the interval of beams that could meet each. An
/// interval with `last` < `first` wraps: it consists of the beams from `first` to the end and from 0 to `last`.
struct alignas(32) Sight {
  static constexpr std::int32_t narrow_beams = 16;  ///< an interval of so many beams, or fewer, is narrow

  float near_m2[EightBounds::width];
  std::int32_t first[EightBounds::width], last[EightBounds::width];
  unsigned narrow;  ///< a bit per narrow interval that does not wrap
  unsigned solids;  ///< a bit per rectangle of a solid
};

/// A few beams, in floats, for the intersection test of eight rectangles.
struct FewBeams {
  static constexpr int most = 16;
  static_assert(most < 32, "a set of few beams fits the bits of a lane");
  float low_x, low_y, high_x, high_y;  ///< the origin, as in View
  float x[most], y[most];              ///< directions
  float reach_m[most];                 ///< rounded up
};

/// The result for eight rectangles: the beams that meet each, a bit per beam, and a lower bound of its distance.
struct alignas(32) MetByFew {
  std::uint32_t beams[EightBounds::width];
  float near_m[EightBounds::width];
};

/// A solid and the blocks of beams to test against it.
struct Question {
  const Outline& outline;
  std::uint32_t solid;
  std::int32_t first_block, last_block;
  float near_m2;  ///< lower bound of its squared distance
};

/// A box or a disc that only the beams `first` to `last` can meet.
struct NarrowQuestion {
  const Outline* outline;
  std::int32_t first, last;
};

struct Kernels {
  const char* name;
  /// Rotates directions given in a fan's frame, whose x axis is `axis`, into the world frame. Returns the number done:
  /// all but a remainder of less than a vector.
  std::size_t (*turn)(const Point* directions, std::size_t count, Point axis, double* x, double* y);
  /// A bit per rectangle of the node that is in view, without those that are occluded and span at most two blocks of
  /// beams. `sight` is defined for the rectangles in the result only.
  unsigned (*look)(const TreeNode& node, const View& view, Sight& sight);
  /// True if all blocks `first` to `last` are nearer than `than_m2`. Reads beyond the last block, without effect.
  bool (*all_nearer)(const float* farthest_m2, std::int32_t first, std::int32_t last, float than_m2);
  /// True if all beams `first` to `last` end nearer than `than_m`. Reads beyond the last beam, without effect.
  bool (*all_end_nearer)(const double* range_m, std::int32_t first, std::int32_t last, double than_m);
  /// A bit per rectangle that overlaps `wanted`.
  unsigned (*overlap)(const EightBounds& bounds, const FloatBounds& wanted);
  /// Sets `met` to the beams (a bit per beam, a subset of `beams`) that meet each rectangle within their reach. Returns
  /// a bit per rectangle that any beam meets. `near_m` is a lower bound of all distances: beams with less reach meet
  /// none.
  unsigned (*meet)(const EightBounds& bounds, float near_m, const FewBeams& few, std::uint32_t beams, MetByFew& met);
  /// Lowers the ranges of the beams that hit the box (the disc) nearer. Of equally near solids the lesser number
  /// counts.
  void (*ask_box)(const Question& question, const Beams& beams);
  void (*ask_disc)(const Question& question, const Beams& beams);
  /// The same for `count` solids with few beams each, with few branches. Does not write solid_of. Beams beyond a
  /// question's last are tested, too.
  void (*ask_narrow)(const NarrowQuestion* questions, int count, const Beams& beams);
};

/// The widest variant that this processor can execute.
const Kernels& kernels();
/// All variants that it can execute, the widest last.
std::vector<const Kernels*> all_kernels();

// One variant per instruction set, also of those that the processor lacks. A portable build has the first alone; AVX2
// and AVX-512 exist on x86-64 only.
extern const Kernels kernels_portable, kernels_baseline, kernels_avx2, kernels_avx512;

}  // namespace waitpoint::world
