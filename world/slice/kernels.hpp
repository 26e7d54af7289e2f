// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of scans and of looking for neighbours, in the widest instructions that this processor has.
//
// All variants give the same bits: `look`, `all_nearer`, `all_end_nearer`, `overlap` and `meet` only cull, and the
// others do what hit_distance() does, with the same operations in the same order (sums, products, quotients and square
// roots are exact to the last bit in every width), so that any beam alone and the same beam within a fan agree.
#pragma once

#include <cstdint>
#include <vector>

#include "world/planar/outline.hpp"
#include "world/slice/tree.hpp"

namespace waitpoint::world {

/// In place of a solid's number: nothing was hit.
inline constexpr std::uint32_t no_solid = 0xFFFFFFFFu;

/// The beams of a scan, of which blocks of eight are treated together.
struct Beams {
  static constexpr int block = 8;
  static constexpr int blocks_read_beyond = 8, beams_read_beyond = 8;
  Point origin;
  const double *x, *y;      ///< directions
  double* range_m;          ///< the nearest hit so far, or the limit
  float* farthest_m2;       ///< by block: no range in it is beyond
  std::uint32_t* solid_of;  ///< who was hit, or null if nobody asks
};

/// A fan of beams as eight rectangles are looked at from its origin, in floats.
struct View {
  float low_x, low_y, high_x, high_y;  ///< the origin, a little smaller and a little larger than it is
  float axis_x, axis_y;                ///< the middle of the fan
  float half_rad;                      ///< from there to the last beam
  float per_rad;                       ///< beams
  std::int32_t beams;
  float reach_m2;            ///< finite
  const float* farthest_m2;  ///< as Beams'
};

/// A rectangle in floats, like those of a tree.
struct FloatBounds {
  float low_x, low_y, high_x, high_y;
};

/// What a view has of eight rectangles: the least squared distance, and the beams that could meet it. Beams can be
/// those from `first` to the end and from 0 to `last`: then `last` < `first`.
struct alignas(32) Sight {
  float near_m2[EightBounds::width];
  std::int32_t first[EightBounds::width], last[EightBounds::width];
};

/// A few beams as eight rectangles are met by them, in floats.
struct FewBeams {
  static constexpr int most = 16;
  float low_x, low_y, high_x, high_y;  ///< the origin, as a view's
  float x[most], y[most];              ///< directions
  float reach_m[most];                 ///< rounded up
};

/// Which of them meet each of eight rectangles, a bit for each, and how near each rectangle is, at least.
struct alignas(32) MetByFew {
  std::uint32_t beams[EightBounds::width];
  float near_m[EightBounds::width];
};

/// A solid, and which blocks of beams are to be asked about it.
struct Question {
  const Outline& outline;
  std::uint32_t solid;
  std::int32_t first_block, last_block;
  float near_m2;  ///< it is no nearer
};

/// A box or a disc that only a few beams can meet: `first` to `last`.
struct NarrowQuestion {
  const Outline* outline;
  std::int32_t first, last;
};

struct Kernels {
  const char* name;
  /// Turns directions into the frame in which `axis` is the x axis of theirs; gives how many it has done: all but a few
  /// at the end.
  std::size_t (*turn)(const Point* directions, std::size_t count, Point axis, double* x, double* y);
  /// A bit for each rectangle that is in view, but for those that are hidden and as narrow as two blocks of beams;
  /// `sight` means something for those.
  unsigned (*look)(const EightBounds& bounds, const View& view, Sight& sight);
  /// Whether all of these blocks are nearer than that; blocks beyond the last are read, too, but do not count.
  bool (*all_nearer)(const float* farthest_m2, std::int32_t first, std::int32_t last, float than_m2);
  /// Whether all of these beams end nearer than that; beams beyond the last are read, too, but do not count.
  bool (*all_end_nearer)(const double* range_m, std::int32_t first, std::int32_t last, double than_m);
  /// A bit for each rectangle that overlaps `wanted`.
  unsigned (*overlap)(const EightBounds& bounds, const FloatBounds& wanted);
  /// Which of these beams, a bit for each, meet each rectangle within their reach; gives a bit for each that any meets.
  /// None is nearer than `near_m`, and beams that do not reach so far meet none.
  unsigned (*meet)(const EightBounds& bounds, float near_m, const FewBeams& few, std::uint32_t beams, MetByFew& met);
  /// Lowers the ranges of beams that meet the box (the disc) nearer; the origin lies outside of it. Of equally near
  /// solids the one of the lesser number is hit.
  void (*ask_box)(const Question& question, const Beams& beams);
  void (*ask_disc)(const Question& question, const Beams& beams);
  /// The same for some solids, and each one's few beams: at least those, with as few branches as can be. Who was hit is
  /// not told. Beams beyond the last are asked, too.
  void (*ask_narrow)(const NarrowQuestion* questions, int count, const Beams& beams);
};

/// The widest that this processor has.
const Kernels& kernels();
/// All that it has, the widest last.
std::vector<const Kernels*> all_kernels();

// Of each instruction set, whether the processor has it or not; those with names only where it is one of x86.
extern const Kernels kernels_baseline, kernels_avx2, kernels_avx512;

}  // namespace waitpoint::world
