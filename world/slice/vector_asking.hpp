// SPDX-License-Identifier: BSD-3-Clause
// hit_distance() for several beams at once, in doubles and to the last bit (see kernels.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

#include "world/planar/ray.hpp"
#include "world/slice/kernels.hpp"
#include "world/slice/vectors.hpp"

namespace waitpoint::world {

template <int lanes, Instructions set = Instructions::own>
struct VectorAsking {
  using V = Vectors<lanes, set>;
  using Doubles = typename V::Doubles;
  using Longs = typename V::Longs;
  static_assert(Beams::block % lanes == 0, "a block of beams fills whole vectors");
  static_assert(Beams::beams_read_beyond >= lanes,
                "the padding of a scan covers a vector that begins at its last beam");

  // Applies the hits at `distance` to the beams from `at` on; returns their new ranges.
  static Doubles lower(const Beams& beams, int at, Doubles distance, Longs hit, std::uint32_t solid) {
    const Doubles range = V::template load<Doubles>(beams.range_m + at);
    const Longs nearer = hit & (Longs)(distance < range);
    if (beams.solid_of != nullptr) {
      const unsigned won = V::bits(nearer);
      for (unsigned rest = won | V::bits(hit & (Longs)(distance == range)); rest != 0; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        std::uint32_t& holder = beams.solid_of[at + lane];
        // A hit exactly at the limit counts as none: a beam without a solid keeps none.
        if ((won >> lane & 1) != 0 || (holder != no_solid && solid < holder)) holder = solid;
      }
    }
    const Doubles lowered = nearer ? distance : range;
    V::store(beams.range_m + at, lowered);
    return lowered;
  }

  static void set_farthest(float& farthest_m2, Doubles ranges) {
    const float rounded = static_cast<float>(V::greatest_of(ranges));
    farthest_m2 = rounded * rounded * (1 + 1e-6f);
  }

  // Calls `answer(first beam, distances, hits)` for all blocks in which the solid could be nearest.
  template <class Answer>
  static void ask(const Question& question, const Beams& beams, Answer answer) {
    for (std::int32_t block = question.first_block; block <= question.last_block; ++block) {
      if (beams.farthest_m2[block] < question.near_m2) continue;
      Doubles farthest{};
      for (int i = 0; i < Beams::block; i += lanes) {
        const int at = block * Beams::block + i;
        Doubles distance;
        Longs hit;
        answer(at, distance, hit);
        farthest = V::greatest(farthest, lower(beams, at, distance, hit, question.solid));
      }
      set_farthest(beams.farthest_m2[block], farthest);
    }
  }

  typedef double Pair __attribute__((vector_size(16)));  // by x and by y of a box's own frame

  // A box as seen from the beams' origin.
  struct Facing {
    Pair near;            // from the origin to the nearer sides; 0 if it is between the sides
    Pair forth, back;     // to the side by which a beam leaves that leads forth along the axis, or back
    std::int64_t inside;  // all bits or none
  };
  __attribute__((always_inline)) static Facing facing(const Outline& box, Point origin) {
    const Pair from = {origin.x - box.centre.x, origin.y - box.centre.y}, turned = {from[1], -from[0]};
    const Pair o = box.axis_cos * from + box.axis_sin * turned;
    const Pair half = Pair{box.half_length_m, box.half_width_m} + seal_m;
    const Pair beside = (o < 0 ? -o : o) - half, none = {};
    const auto between = beside <= none;
    return {beside > none ? beside : none, half - o, half + o, between[0] & between[1]};
  }

  // The hits of a box by the beams with these directions, undecided ones excluded.
  struct Hits {
    Doubles distance;
    Longs hit, undecided;
  };
  // hit_distance() computes the distances along the ray of its entry and exit by x and by y:
  //
  //   near_x / |dx|, near_y / |dy|, far_x / |dx|, far_y / |dy|     for an origin outside, |d| in the box's own frame
  //
  // and has a hit if the greater entry comes before the lesser exit. Products decide the order without a quotient,
  // unless the two are equal but for rounding; those few beams are undecided. `far` is negative if the beam leads away,
  // and then smaller than the entry by more than any rounding.
  __attribute__((always_inline)) static Hits hits(const Outline& box, const Facing& from, Doubles x, Doubles y) {
    const Doubles cosine = V::all(box.axis_cos), sine = V::all(box.axis_sin);
    const Doubles near_x = V::all(from.near[0]), near_y = V::all(from.near[1]);
    const Doubles d_x = cosine * x + sine * y, d_y = cosine * y - sine * x;
    const Doubles along_x = V::absolute(d_x), along_y = V::absolute(d_y);
    const Doubles far_x = d_x < 0 ? V::all(from.back[0]) : V::all(from.forth[0]);
    const Doubles far_y = d_y < 0 ? V::all(from.back[1]) : V::all(from.forth[1]);
    const Doubles enter_x = near_x * along_y, enter_y = near_y * along_x;
    const Doubles spare = V::least(far_y * along_x - enter_x, far_x * along_y - enter_y);
    const Doubles rounding = 1e-14 * (enter_x + enter_y) + 1e-290;
    const Longs by_x = enter_x > enter_y, hit = spare > rounding;
    const Longs undecided =
        (Longs)(V::absolute(spare) <= rounding) | (hit & (Longs)(V::absolute(enter_x - enter_y) <= rounding));
    return {(by_x ? near_x : near_y) / (by_x ? along_x : along_y), hit & ~undecided, undecided};
  }

  template <class Asker>
  __attribute__((always_inline)) static void ask_box(const Outline& box, const Beams& beams, Asker asker) {
    const Facing from = facing(box, beams.origin);
    if (from.inside != 0) return hit_all(asker);
    asker([&](int at, Doubles& distance, Longs& hit) __attribute__((always_inline)) {
      const Doubles x = V::template load<Doubles>(beams.x + at), y = V::template load<Doubles>(beams.y + at);
      const Hits found = hits(box, from, x, y);
      distance = found.distance;
      hit = found.hit;
      for (unsigned rest = V::bits(found.undecided); rest != 0; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        const double exact = hit_distance(box, Ray{beams.origin, Point{x[lane], y[lane]}});
        distance[lane] = exact;
        hit[lane] = exact < no_hit ? -1 : 0;
      }
    });
  }

  template <class Asker>
  __attribute__((always_inline)) static void ask_disc(const Outline& disc, const Beams& beams, Asker asker) {
    const double to_x = disc.centre.x - beams.origin.x, to_y = disc.centre.y - beams.origin.y;
    const double square = disc.radius_m * disc.radius_m;
    if (to_x * to_x + to_y * to_y <= square) return hit_all(asker);
    asker([&](int at, Doubles& distance, Longs& hit) __attribute__((always_inline)) {
      const Doubles x = V::template load<Doubles>(beams.x + at), y = V::template load<Doubles>(beams.y + at);
      const Doubles along = to_x * x + to_y * y, offset = to_x * y - to_y * x;
      const Doubles rest = square - offset * offset;
      hit = (along > 0) & (rest >= 0);
      distance = V::greatest(along - V::root(rest), Doubles{});
    });
  }

  template <class Asker>
  __attribute__((always_inline)) static void hit_all(Asker asker) {
    asker([](int, Doubles& distance, Longs& hit) __attribute__((always_inline)) {
      distance = Doubles{};
      hit = ~Longs{};
    });
  }

  static void ask_box(const Question& question, const Beams& beams) {
    ask_box(question.outline, beams, [&](auto answer) { ask(question, beams, answer); });
  }
  static void ask_disc(const Question& question, const Beams& beams) {
    ask_disc(question.outline, beams, [&](auto answer) { ask(question, beams, answer); });
  }

  // Of beams whose hits rounding decides. Out of line: a call within a loop would keep its vectors out of registers.
  __attribute__((noinline, cold)) static void ask_each(const NarrowQuestion& q, const Beams& beams) {
    for (int at = q.first; at <= q.last; ++at) {
      const double exact = hit_distance(*q.outline, Ray{beams.origin, Point{beams.x[at], beams.y[at]}});
      if (exact < beams.range_m[at]) beams.range_m[at] = exact;
    }
  }

  __attribute__((always_inline)) static void lower(const Beams& beams, int at, Doubles distance, Longs hit) {
    const Doubles range = V::template load<Doubles>(beams.range_m + at);
    V::store(beams.range_m + at, hit & (Longs)(distance < range) ? distance : range);
  }

  static std::int32_t block_of(std::int32_t beam) {
    return static_cast<std::int32_t>(static_cast<unsigned>(beam) / Beams::block);
  }

  // Without branches on the result: every range is written, lowered or not, and every block's bound is updated once. A
  // range is lowered about every second time, and a mispredicted branch costs as much as the test.
  static void ask_narrow(const NarrowQuestion* questions, int count, const Beams& beams) {
    std::int32_t first_block = 0x7FFFFFFF, last_block = -1;
    for (int i = 0; i < count; ++i) {
      const NarrowQuestion& q = questions[i];
      const std::int32_t first = block_of(q.first), last = block_of(q.last);
      first_block = first < first_block ? first : first_block;
      last_block = last > last_block ? last : last_block;
      if (!q.outline->is_box) {
        ask_disc(
            *q.outline, beams, [&](auto answer) __attribute__((always_inline)) {
              int at = q.first;
              do {
                Doubles distance;
                Longs hit;
                answer(at, distance, hit);
                lower(beams, at, distance, hit);
                at += lanes;
              } while (at <= q.last);
            });
        continue;
      }
      const Facing from = facing(*q.outline, beams.origin);
      Longs undecided = from.inside - Longs{};
      int at = q.first;
      do {
        const Hits found =
            hits(*q.outline, from, V::template load<Doubles>(beams.x + at), V::template load<Doubles>(beams.y + at));
        undecided |= found.undecided;
        lower(beams, at, found.distance, found.hit);
        at += lanes;
      } while (at <= q.last);
      if (V::bits(undecided) != 0) ask_each(q, beams);
    }
    for (std::int32_t block = first_block; block <= last_block; ++block) note_farthest(block, beams);
  }

  static void note_farthest(std::int32_t block, const Beams& beams) {
    Doubles farthest{};
    for (int i = 0; i < Beams::block; i += lanes)
      farthest =
          V::greatest(farthest, V::template load<Doubles>(beams.range_m + std::ptrdiff_t{block} * Beams::block + i));
    set_farthest(beams.farthest_m2[block], farthest);
  }
};

}  // namespace waitpoint::world
