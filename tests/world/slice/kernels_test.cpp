// SPDX-License-Identifier: BSD-3-Clause
// The operations on vectors and the kernels made of them: those in the processor's instructions against the portable
// ones, bit for bit (any NaN for a NaN).
#include "world/slice/kernels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "tests/world/scenes.hpp"
#include "world/slice/vectors.hpp"

namespace waitpoint::world {
namespace {

template <class Number>
constexpr Number special_numbers[] = {Number(0),
                                      -Number(0),
                                      std::numeric_limits<Number>::infinity(),
                                      -std::numeric_limits<Number>::infinity(),
                                      std::numeric_limits<Number>::quiet_NaN(),
                                      std::numeric_limits<Number>::denorm_min(),
                                      -std::numeric_limits<Number>::denorm_min(),
                                      std::numeric_limits<Number>::max(),
                                      std::numeric_limits<Number>::lowest(),
                                      std::numeric_limits<Number>::min(),
                                      Number(1),
                                      Number(-1)};

/// Numbers of all magnitudes; every third a special one.
template <class Number>
Number any_number(Draws& draw) {
  if (draw.below(3) == 0) return special_numbers<Number>[draw.below(std::size(special_numbers<Number>))];
  const int exponent = std::numeric_limits<Number>::max_exponent;
  return std::ldexp(static_cast<Number>(draw(-1, 1)),
                    static_cast<int>(draw.below(2 * static_cast<std::uint64_t>(exponent))) - exponent);
}

bool same(double a, double b) {
  return (a != a && b != b) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

template <class Vector>
bool same_lanes(Vector a, Vector b) {
  bool all = true;
  for (std::size_t i = 0; i < sizeof(Vector) / sizeof(a[0]); ++i) all = all && same(a[i], b[i]);
  return all;
}

template <int lanes>
void expect_the_same_operations() {
  using Own = Vectors<lanes, Instructions::own>;
  using Portable = Vectors<lanes, Instructions::portable>;
  Draws draw(lanes);
  std::array<float, 100> table;
  for (float& entry : table) entry = any_number<float>(draw);
  for (int k = 0; k < 20'000; ++k) {
    typename Own::Doubles a, b;
    for (int i = 0; i < lanes; ++i) a[i] = any_number<double>(draw), b[i] = any_number<double>(draw);
    typename Own::Floats c, d;
    typename Own::Ints at;
    for (int i = 0; i < Own::float_lanes; ++i) {
      c[i] = any_number<float>(draw), d[i] = any_number<float>(draw);
      at[i] = static_cast<std::int32_t>(draw.below(table.size()));
    }
    ASSERT_TRUE(same_lanes(Own::root(a), Portable::root(a))) << a[0] << ' ' << a[1];
    ASSERT_TRUE(same_lanes(Own::gather(table.data(), at), Portable::gather(table.data(), at)));
    const auto less = (typename Own::Longs)(a < b);  // clang's comparison has another type of the same lanes
    const auto below = (typename Own::Ints)(c < d);
    ASSERT_EQ(Own::bits(less), Portable::bits(less));
    ASSERT_EQ(Own::bits(below), Portable::bits(below));
    for (int i = 0; i < lanes; ++i) {
      ASSERT_TRUE(same(Own::root(a)[i], std::sqrt(a[i]))) << a[i];
      ASSERT_EQ(Own::bits(less) >> i & 1, a[i] < b[i] ? 1 : 0);
      ASSERT_TRUE(same(Own::least(a, b)[i], b[i] < a[i] ? b[i] : a[i]));
      ASSERT_TRUE(same(Own::greatest(a, b)[i], a[i] < b[i] ? b[i] : a[i]));
      ASSERT_TRUE(same(Own::absolute(a)[i], std::fabs(a[i])));
    }
    for (int i = 0; i < Own::float_lanes; ++i) ASSERT_EQ(Own::bits(below) >> i & 1, c[i] < d[i] ? 1 : 0);
  }
}

TEST(Kernels, OperationsOfTheProcessorAreThePortableOnesToTheLastBit) {
  // Vectors that every processor has; the kernels below have the wider ones.
  expect_the_same_operations<2>();
}

TEST(Kernels, APortableOneIsAlwaysThereAndFirst) {
  EXPECT_STREQ(all_kernels().front()->name, "portable");
#if defined(WAITPOINT_PORTABLE)
  EXPECT_EQ(all_kernels().size(), 1u);
#elif defined(__x86_64__) || defined(__aarch64__)
  EXPECT_GE(all_kernels().size(), 2u);
#endif
}

/// Calls `check(variant)` for all but the portable one.
template <class Check>
void for_each_variant(Check check) {
  const std::vector<const Kernels*> all = all_kernels();
  for (std::size_t i = 1; i < all.size(); ++i) {
    SCOPED_TRACE(all[i]->name);
    check(*all[i]);
  }
}

TEST(Kernels, TurnAnyDirectionsToTheSameBits) {
  constexpr std::size_t count = 64;
  Draws draw(3);
  for (int k = 0; k < 500; ++k) {
    std::array<Point, count> directions;
    for (Point& direction : directions) direction = {any_number<double>(draw), any_number<double>(draw)};
    const Point axis = {any_number<double>(draw), any_number<double>(draw)};
    std::array<double, count> x, y, own_x, own_y;
    ASSERT_EQ(kernels_portable.turn(directions.data(), count, axis, x.data(), y.data()), count);
    for_each_variant([&](const Kernels& variant) {
      ASSERT_EQ(variant.turn(directions.data(), count, axis, own_x.data(), own_y.data()), count);
      for (std::size_t i = 0; i < count; ++i) ASSERT_TRUE(same(own_x[i], x[i]) && same(own_y[i], y[i])) << i;
    });
  }
}

EightBounds any_bounds(Draws& draw) {
  EightBounds bounds = EightBounds::nowhere();
  const int used = static_cast<int>(1 + draw.below(EightBounds::width));
  for (int i = 0; i < used; ++i) {
    // In quarters of a metre: corners and sides are often in line with the origin, or at it.
    const auto quarter = [&draw] { return static_cast<float>(draw.below(17)) / 4 - 2; };
    const float x = quarter(), y = quarter();
    bounds.low_x[i] = x, bounds.high_x[i] = x + static_cast<float>(draw.below(4)) / 4;
    bounds.low_y[i] = y, bounds.high_y[i] = y + static_cast<float>(draw.below(4)) / 4;
  }
  return bounds;
}

TEST(Kernels, LookAtRectanglesWithTheSameResult) {
  Draws draw(4);
  int at_a_corner = 0;
  for (int k = 0; k < 20'000; ++k) {
    constexpr std::int32_t beams = 90, blocks = (beams + Beams::block - 1) / Beams::block;
    std::array<float, blocks + Beams::blocks_read_beyond> farthest_m2{};
    for (std::int32_t i = 0; i < blocks; ++i) farthest_m2[i] = static_cast<float>(draw(0, 9));
    const double heading = draw(-3.2, 3.2), field = draw(0.1, 6.28);
    const View view = {.low_x = 0,
                       .low_y = 0,
                       .high_x = 0,
                       .high_y = 0,
                       .axis_x = static_cast<float>(std::cos(heading)),
                       .axis_y = static_cast<float>(std::sin(heading)),
                       .half_rad = static_cast<float>(field / 2),
                       .per_rad = static_cast<float>((beams - 1) / field),
                       .beams = beams,
                       .reach_m2 = static_cast<float>(draw(1, 9)),
                       .farthest_m2 = farthest_m2.data()};
    TreeNode node = TreeNode::empty();
    node.bounds = any_bounds(draw);
    for (int i = 0; i < EightBounds::width; ++i) node.child[i] = draw.below(2) == 0 ? i : ~i;
    at_a_corner += node.bounds.low_x[0] == 0 && node.bounds.high_y[0] == 0 ? 1 : 0;
    Sight portable, own;
    const unsigned seen = kernels_portable.look(node, view, portable);
    for_each_variant([&](const Kernels& variant) {
      ASSERT_EQ(variant.look(node, view, own), seen);
      ASSERT_EQ(own.solids, portable.solids);
      ASSERT_EQ(own.narrow & seen, portable.narrow & seen);
      for (int i = 0; i < EightBounds::width; ++i) {
        if ((seen >> i & 1) == 0) continue;
        ASSERT_TRUE(same(own.near_m2[i], portable.near_m2[i]));
        ASSERT_TRUE(own.first[i] == portable.first[i] && own.last[i] == portable.last[i]) << i;
      }
    });
  }
  EXPECT_GT(at_a_corner, 50);  // whose direction from the origin is no number
}

TEST(Kernels, MeetAndOverlapRectanglesWithTheSameResult) {
  Draws draw(5);
  for (int k = 0; k < 20'000; ++k) {
    const EightBounds bounds = any_bounds(draw);
    const FloatBounds wanted = {any_number<float>(draw), any_number<float>(draw), static_cast<float>(draw(-2, 2)),
                                static_cast<float>(draw(-2, 2))};
    FewBeams few{};
    for (int i = 0; i < FewBeams::most; ++i) {
      const double angle = draw(-3.2, 3.2);
      few.x[i] = static_cast<float>(std::cos(angle)), few.y[i] = static_cast<float>(std::sin(angle));
      few.reach_m[i] = static_cast<float>(draw(0, 3));
    }
    const auto asked = static_cast<std::uint32_t>(draw.below(1u << FewBeams::most));
    const auto near_m = static_cast<float>(draw(0, 2));
    MetByFew portable{}, own{};
    const unsigned met = kernels_portable.meet(bounds, near_m, few, asked, portable);
    for_each_variant([&](const Kernels& variant) {
      ASSERT_EQ(variant.overlap(bounds, wanted), kernels_portable.overlap(bounds, wanted));
      ASSERT_EQ(variant.meet(bounds, near_m, few, asked, own), met);
      for (int i = 0; i < EightBounds::width; ++i)
        ASSERT_TRUE((met >> i & 1) == 0 ||
                    (own.beams[i] == portable.beams[i] && same(own.near_m[i], portable.near_m[i])));
    });
  }
}

TEST(Kernels, CompareAnyRangesWithTheSameResult) {
  constexpr std::int32_t count = 40;
  Draws draw(6);
  for (int k = 0; k < 20'000; ++k) {
    std::array<float, count + Beams::blocks_read_beyond> farthest_m2{};
    std::array<double, count + Beams::beams_read_beyond> range_m{};
    for (std::int32_t i = 0; i < count; ++i) {
      farthest_m2[i] = draw.below(20) == 0 ? any_number<float>(draw) : 1;
      range_m[i] = draw.below(20) == 0 ? any_number<double>(draw) : 1;
    }
    const auto first = static_cast<std::int32_t>(draw.below(count));
    const auto last = first + static_cast<std::int32_t>(draw.below(static_cast<std::uint64_t>(count - first)));
    const auto than = static_cast<float>(draw(0.5, 3));
    for_each_variant([&](const Kernels& variant) {
      ASSERT_EQ(variant.all_nearer(farthest_m2.data(), first, last, than),
                kernels_portable.all_nearer(farthest_m2.data(), first, last, than));
      ASSERT_EQ(variant.all_end_nearer(range_m.data(), first, last, than),
                kernels_portable.all_end_nearer(range_m.data(), first, last, than));
    });
  }
}

}  // namespace
}  // namespace waitpoint::world
