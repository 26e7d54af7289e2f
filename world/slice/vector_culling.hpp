// SPDX-License-Identifier: BSD-3-Clause
// Visibility and occlusion tests of a fan, in floats with margins (see kernels.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "world/slice/kernels.hpp"
#include "world/slice/vectors.hpp"

namespace waitpoint::world {

template <int lanes, Instructions set = Instructions::own>
struct VectorCulling {
  using V = Vectors<lanes, set>;
  using Doubles = typename V::Doubles;
  using Longs = typename V::Longs;
  using Floats = typename V::Floats;
  using Ints = typename V::Ints;
  static_assert(EightBounds::width % V::float_lanes == 0, "a node's rectangles fill whole vectors");
  static_assert(FewBeams::most % V::float_lanes == 0, "few beams fill whole vectors");
  static_assert(Beams::blocks_read_beyond >= V::float_lanes && Beams::beams_read_beyond >= lanes,
                "the padding of a scan covers a vector that begins at its last beam or block");

  // atan2 with an error of at most 2.1e-5: a polynomial of degree 5 in the square, interpolated at Chebyshev points.
  static Floats angle(Floats y, Floats x) {
    const Floats ax = V::absolute(x), ay = V::absolute(y);
    const Floats q = V::least(ax, ay) / V::greatest(ax, ay), s = q * q, s_2 = s * s;
    // In pairs, for a shorter chain of dependent operations.
    Floats a = q * ((0.99996477f + s * -0.33154461f) + s_2 * ((0.18446356f + s * -0.09075202f) + s_2 * 0.02328601f));
    a = ay > ax ? 1.57079633f - a : a;
    a = x < 0 ? 3.14159265f - a : a;
    return y < 0 ? -a : a;
  }
  // Above the sum of that error, the rounding of its arguments, and the rounding of a beam's number (at most 2^20).
  static constexpr float margin_rad = 5e-5f;
  static constexpr float pi = 3.14159265f;

  static unsigned look(const TreeNode& node, const View& view, Sight& sight) {
    unsigned seen = 0;
    sight.narrow = sight.solids = 0;
    for (int at = 0; at < EightBounds::width; at += V::float_lanes) {
      sight.solids |= V::bits(V::template load<Ints>(reinterpret_cast<const std::int32_t*>(&node.child) + at) < 0)
                      << at;
      seen |= look_at(node.bounds, view, sight, at) << at;
    }
    return seen;
  }

  static unsigned look_at(const EightBounds& bounds, const View& view, Sight& sight, int at) {
    const Floats low_x = V::template load<Floats>(bounds.low_x + at) - view.high_x;
    const Floats low_y = V::template load<Floats>(bounds.low_y + at) - view.high_y;
    const Floats high_x = V::template load<Floats>(bounds.high_x + at) - view.low_x;
    const Floats high_y = V::template load<Floats>(bounds.high_y + at) - view.low_y;

    const Floats beside_x = V::greatest(V::greatest(low_x, -high_x), Floats{});
    const Floats beside_y = V::greatest(V::greatest(low_y, -high_y), Floats{});
    const Floats near_m2 = (beside_x * beside_x + beside_y * beside_y) * (1 - 1e-6f);
    const unsigned in_reach = V::bits((Ints)(near_m2 <= view.reach_m2));
    if (in_reach == 0) return 0;

    // The rightmost and the leftmost corner as seen from the origin.
    const Ints west = high_x < 0, south = high_y < 0;
    const Ints east = low_x > 0, north = low_y > 0;
    const Floats right_x = (north | (west & ~south)) ? high_x : low_x;
    const Floats right_y = (west | (south & ~east)) ? high_y : low_y;
    const Floats left_x = (south | (west & ~north)) ? high_x : low_x;
    const Floats left_y = (west | (north & ~east)) ? low_y : high_y;
    const Floats right =
        angle(right_y * view.axis_x - right_x * view.axis_y, right_x * view.axis_x + right_y * view.axis_y) -
        margin_rad;
    Floats left =
        angle(left_y * view.axis_x - left_x * view.axis_y, left_x * view.axis_x + left_y * view.axis_y) + margin_rad;
    // Each margin exceeds the error of its angle: left < right only if the interval contains the direction behind.
    left = left < right ? left + 2 * pi : left;

    const Ints first = numbers((right + view.half_rad) * view.per_rad, view) + 1;
    const Ints last_any = numbers((left + view.half_rad) * view.per_rad, view), last_beam = Ints{} + (view.beams - 1);
    const Ints last = last_any > last_beam ? last_beam : last_any;
    V::store(sight.near_m2 + at, near_m2);
    V::store(sight.first + at, first);
    V::store(sight.last + at, last);
    unsigned narrow = V::bits((first <= last) & (last - first < Sight::narrow_beams));
    const unsigned around = ~V::bits(west | east | south | north),
                   behind = V::bits((Ints)((left > pi) | (right < -pi)));
    unsigned seen = in_reach & V::bits((Ints)(first <= last) & ~hidden(near_m2, first, last, view));
    for (unsigned rest = in_reach & (around | behind); rest != 0; rest &= rest - 1) {
      const int lane = __builtin_ctz(rest);
      std::int32_t &first_of_it = sight.first[at + lane], &last_of_it = sight.last[at + lane];
      seen |= 1u << lane;
      if ((around >> lane & 1) != 0) {
        first_of_it = 0;
        last_of_it = view.beams - 1;
      } else if (!look_behind(right[lane], left[lane], view, first_of_it, last_of_it)) {
        seen &= ~(1u << lane);
      }
      const bool is_narrow = first_of_it <= last_of_it && last_of_it - first_of_it < Sight::narrow_beams;
      narrow = (narrow & ~(1u << lane)) | (is_narrow ? 1u << lane : 0u);
    }
    sight.narrow |= narrow << at;
    return seen;
  }

  // True in lanes whose beams lie in one or two blocks with only nearer ranges.
  static Ints hidden(Floats near_m2, Ints first, Ints last, const View& view) {
    static_assert(Beams::block == 8);
    constexpr int block_shift = 3;
    const Ints first_block = V::greatest(first, Ints{}) >> block_shift,
               last_block = V::greatest(last, Ints{}) >> block_shift;
    return (Ints)(V::gather(view.farthest_m2, first_block) < near_m2) &
           (Ints)(V::gather(view.farthest_m2, last_block) < near_m2) & (Ints)(last_block - first_block <= 1);
  }

  // Rounded down, clamped to -1 and the number of beams; -1 for no number, as for the direction of a corner at the
  // origin. Clamped before the conversion, which depends on the processor for values that do not fit.
  static Ints numbers(Floats at, const View& view) {
    const Floats within = V::least(V::greatest(V::all(-1.0f), at), V::all(static_cast<float>(view.beams)));
    return __builtin_convertvector(within + 2, Ints) - 2;
  }
  static std::int32_t number(float at, const View& view) {
    const float end = static_cast<float>(view.beams);
    return static_cast<std::int32_t>((at < -1 ? -1 : at > end ? end : at) + 2) - 2;
  }

  // For a rectangle across the direction behind the fan's axis: beams at both ends of the fan can meet it.
  static bool look_behind(float right, float left, const View& view, std::int32_t& first, std::int32_t& last) {
    const std::int32_t from_start = number((left - 2 * pi + view.half_rad) * view.per_rad, view);
    const std::int32_t to_end = number((right + 2 * pi + view.half_rad) * view.per_rad, view) + 1;
    const bool meets = first <= last;
    if (left > pi && from_start >= 0) {
      if (!meets) first = 0;
      last = from_start < view.beams ? from_start : view.beams - 1;
    } else if (right < -pi && to_end < view.beams) {
      if (!meets) last = view.beams - 1;
      first = to_end;
    } else {
      return meets;
    }
    if (meets && first <= last) {  // the two parts overlap
      first = 0;
      last = view.beams - 1;
    }
    return true;
  }

  static unsigned overlap(const EightBounds& bounds, const FloatBounds& wanted) {
    unsigned met = 0;
    for (int at = 0; at < EightBounds::width; at += V::float_lanes) {
      const Ints apart = (V::template load<Floats>(bounds.low_x + at) > wanted.high_x) |
                         (V::template load<Floats>(bounds.high_x + at) < wanted.low_x) |
                         (V::template load<Floats>(bounds.low_y + at) > wanted.high_y) |
                         (V::template load<Floats>(bounds.high_y + at) < wanted.low_y);
      met |= (~V::bits(apart) & ((1u << V::float_lanes) - 1)) << at;
    }
    return met;
  }

  static std::uint32_t reaching(const FewBeams& few, float near_m) {
    std::uint32_t reaching = 0;
    for (int at = 0; at < FewBeams::most; at += V::float_lanes)
      reaching |= static_cast<std::uint32_t>(V::bits((Ints)(V::template load<Floats>(few.reach_m + at) >= near_m)))
                  << at;
    return reaching;
  }

  // Separating axes: a beam meets a rectangle if neither the axis across the beam nor that along it separates them. The
  // rounding, of the directions too, is far below the enlargement of the rectangles.
  static unsigned meet(const EightBounds& bounds, float near_m, const FewBeams& few, std::uint32_t beams,
                       MetByFew& met) {
    beams &= reaching(few, near_m);
    if (beams == 0) return 0;
    unsigned any = 0;
    for (int at = 0; at < EightBounds::width; at += V::float_lanes) {
      const Floats low_x = V::template load<Floats>(bounds.low_x + at) - few.high_x;
      const Floats low_y = V::template load<Floats>(bounds.low_y + at) - few.high_y;
      const Floats high_x = V::template load<Floats>(bounds.high_x + at) - few.low_x;
      const Floats high_y = V::template load<Floats>(bounds.high_y + at) - few.low_y;
      const Floats c_x = 0.5f * (low_x + high_x), c_y = 0.5f * (low_y + high_y);
      const Floats larger = (V::absolute(c_x) + V::absolute(c_y)) * 2e-6f;
      const Floats half_x = 0.5f * (high_x - low_x) + larger, half_y = 0.5f * (high_y - low_y) + larger;
      Ints met_by{};
      for (std::uint32_t rest = beams; rest != 0; rest &= rest - 1) {
        const int i = __builtin_ctz(rest);
        const Floats x = V::all(few.x[i]), y = V::all(few.y[i]);
        const Floats along_x = V::absolute(x), along_y = V::absolute(y);
        const Floats beside = V::absolute(x * c_y - y * c_x), ahead = x * c_x + y * c_y;
        const Floats half_along = half_x * along_x + half_y * along_y;
        const Ints meets = (beside <= half_x * along_y + half_y * along_x) & (ahead + half_along >= 0) &
                           (ahead - half_along <= few.reach_m[i]);
        met_by |= meets & (Ints{} + static_cast<std::int32_t>(1u << i));
      }
      V::store(reinterpret_cast<std::int32_t*>(met.beams + at), met_by);
      // Lower bound of the distance: the greater of those by x and by y.
      V::store(met.near_m + at, V::greatest(V::absolute(c_x) - half_x, V::absolute(c_y) - half_y));
      any |= V::bits((Ints)(met_by != 0)) << at;
    }
    return any;
  }

  static bool all_nearer(const float* farthest_m2, std::int32_t first, std::int32_t last, float than_m2) {
    Ints place;
    for (int i = 0; i < V::float_lanes; ++i) place[i] = i;
    for (std::int32_t at = first; at <= last; at += V::float_lanes) {
      const Ints farther = (Ints)(V::template load<Floats>(farthest_m2 + at) >= than_m2);
      if (V::bits(farther & (Ints)(place <= last - at)) != 0) return false;
    }
    return true;
  }

  static bool all_end_nearer(const double* range_m, std::int32_t first, std::int32_t last, double than_m) {
    Longs place;
    for (int i = 0; i < lanes; ++i) place[i] = i;
    for (std::int32_t at = first; at <= last; at += lanes) {
      const Longs farther = (Longs)(V::template load<Doubles>(range_m + at) >= than_m);
      if (V::bits(farther & (Longs)(place <= last - at)) != 0) return false;
    }
    return true;
  }

  // `lanes` directions at a time; returns the number done.
  static std::size_t turn(const Point* directions, std::size_t count, Point axis, double* x, double* y) {
    static_assert(sizeof(Point) == 2 * sizeof(double), "directions are loaded as pairs of doubles");
    std::size_t at = 0;
    for (; at + lanes <= count; at += lanes) {
      const Doubles low = V::template load<Doubles>(&directions[at].x),
                    high = V::template load<Doubles>(&directions[at + lanes / 2].x);
      Doubles d_x, d_y;
      if constexpr (lanes == 8) {
        d_x = __builtin_shufflevector(low, high, 0, 2, 4, 6, 8, 10, 12, 14);
        d_y = __builtin_shufflevector(low, high, 1, 3, 5, 7, 9, 11, 13, 15);
      } else if constexpr (lanes == 2) {
        d_x = __builtin_shufflevector(low, high, 0, 2);
        d_y = __builtin_shufflevector(low, high, 1, 3);
      } else {
        d_x = __builtin_shufflevector(low, high, 0, 2, 4, 6);
        d_y = __builtin_shufflevector(low, high, 1, 3, 5, 7);
      }
      V::store(x + at, axis.x * d_x - axis.y * d_y);
      V::store(y + at, axis.y * d_x + axis.x * d_y);
    }
    return at;
  }
};

}  // namespace waitpoint::world
