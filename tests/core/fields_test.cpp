// SPDX-License-Identifier: BSD-3-Clause
#include "core/fields.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace waitpoint {
namespace {

enum class Mode : std::uint8_t { idle, drive };

struct Inner {
  std::uint8_t small = 1;  // padding follows
  double wide = 2;
  static void fields(auto field) {
    field("small", &Inner::small);
    field("wide", &Inner::wide);
  }
};

struct Outer {
  Time date;
  Duration age;
  bool on = false;
  Mode mode = Mode::idle;
  float ratio = 0.5F;
  std::int32_t signed_count = -1;
  Point point;
  Pose pose;
  std::array<Inner, 2> pair;
  Bounded<Inner, 4> list;
  double not_a_field = 0;
  static void fields(auto field) {
    field("date", &Outer::date);
    field("age", &Outer::age);
    field("on", &Outer::on);
    field("mode", &Outer::mode);
    field("ratio", &Outer::ratio);
    field("signed_count", &Outer::signed_count);
    field("point", &Outer::point);
    field("pose", &Outer::pose);
    field("pair", &Outer::pair);
    field("list", &Outer::list);
  }
};

template <class T>
std::uint64_t hash(const T& value) {
  Digest digest;
  add_value(digest, value);
  return digest.value();
}

TEST(Fields, EveryDeclaredFieldCountsHoweverDeep) {
  Outer original;
  original.list.resize(2);
  const std::uint64_t whole = hash(original);
  const auto changed = [&](auto change) {
    Outer copy = original;
    change(copy);
    return hash(copy) != whole;
  };
  EXPECT_TRUE(changed([](Outer& o) { o.date = Time::from_ns(1); }));
  EXPECT_TRUE(changed([](Outer& o) { o.age = Duration::from_ns(1); }));
  EXPECT_TRUE(changed([](Outer& o) { o.on = true; }));
  EXPECT_TRUE(changed([](Outer& o) { o.mode = Mode::drive; }));
  EXPECT_TRUE(changed([](Outer& o) { o.ratio = 0.25F; }));
  EXPECT_TRUE(changed([](Outer& o) { o.signed_count = -2; }));
  EXPECT_TRUE(changed([](Outer& o) { o.point.y = 1e-300; }));
  EXPECT_TRUE(changed([](Outer& o) { o.pose.heading = -0.0; }));
  EXPECT_TRUE(changed([](Outer& o) { o.pair[1].wide = 3; }));
  EXPECT_TRUE(changed([](Outer& o) { o.pair[0].small = 9; }));
  EXPECT_TRUE(changed([](Outer& o) { o.list[1].small = 9; }));
  EXPECT_TRUE(changed([](Outer& o) { o.list.resize(3); }));
  EXPECT_FALSE(changed([](Outer& o) { o.not_a_field = 1; }));
}

struct Before {
  double wide = 2;
  static void fields(auto field) { field("wide", &Before::wide); }
};

struct Later {
  double wide = 2, side = 0, up = 0;
  Bounded<Inner, 2> list;
  static void fields(auto field) {
    field("wide", &Later::wide);
    field("side", &Later::side, added);
    field("up", &Later::up, added);
    field("list", &Later::list, added);
  }
};

TEST(Fields, AnAddedFieldCountsOnlyWhereItIsSet) {
  Later later;
  EXPECT_EQ(hash(later), hash(Before()));
  later.side = 1;
  const std::uint64_t with_side = hash(later);
  EXPECT_NE(with_side, hash(Before()));
  later.side = 0;
  later.up = 1;
  EXPECT_NE(hash(later), with_side) << "the same number in another field";
  later.up = 0;
  later.list.resize(1);
  EXPECT_NE(hash(later), hash(Before()));
}

TEST(Fields, PaddingAndLeftoverElementsDoNotCount) {
  alignas(Inner) unsigned char memory[2][sizeof(Inner)];
  std::memset(memory[0], 0x00, sizeof memory[0]);
  std::memset(memory[1], 0xFF, sizeof memory[1]);
  EXPECT_EQ(hash(*new (memory[0]) Inner), hash(*new (memory[1]) Inner));

  Bounded<Inner, 4> used, fresh;
  used.resize(3);
  used[2].wide = 77;
  used.resize(2);
  fresh.resize(2);
  EXPECT_EQ(hash(used), hash(fresh));
}

TEST(Fields, AreVisitedInOrderAndCanBeWritten) {
  Inner inner;
  std::vector<std::string_view> names;
  for_each_field(inner, [&](std::string_view name, auto& member) {
    names.push_back(name);
    member = 7;
  });
  EXPECT_EQ(names, (std::vector<std::string_view>{"small", "wide"}));
  EXPECT_EQ(inner.small, 7);
  EXPECT_EQ(inner.wide, 7);
}

TEST(Bounded, HoldsUpToItsCapacityInOrder) {
  Bounded<int, 3> list;
  EXPECT_TRUE(list.empty());
  for (int i = 1; i <= 3; ++i) list.push_back(i);
  EXPECT_TRUE(list.full());
  EXPECT_EQ(std::vector<int>(list.begin(), list.end()), (std::vector<int>{1, 2, 3}));
  list.resize(1);
  list.resize(3);
  EXPECT_EQ(std::vector<int>(list.begin(), list.end()), (std::vector<int>{1, 0, 0}));
  list.clear();
  EXPECT_EQ(list.size(), 0u);
}

/// Counts its copies.
struct Counted {
  Counted() = default;
  Counted(const Counted&) { ++copies; }
  Counted& operator=(const Counted&) {
    ++copies;
    return *this;
  }
  static inline int copies = 0;
};

TEST(Bounded, OnlyWhatCountsIsCopied) {
  Bounded<Counted, 100> list;
  list.resize(3);
  Counted::copies = 0;
  Bounded<Counted, 100> other = list;
  EXPECT_EQ(Counted::copies, 3);
  other.resize(50);
  Counted::copies = 0;
  other = list;
  EXPECT_EQ(Counted::copies, 3);
  EXPECT_EQ(other.size(), 3u);
}

TEST(BoundedDeathTest, MoreThanItsCapacityIsABug) {
  Bounded<int, 1> list;
  list.push_back(1);
  EXPECT_DEATH(list.push_back(2), "more elements than a bounded array holds");
  EXPECT_DEATH(list.resize(2), "more elements than a bounded array holds");
}

struct WithFacts {
  std::uint8_t small = 1;
  double wide = 2;
  static void fields(auto field) {
    field("small", &WithFacts::small, CountRange{0, 9}, "a count");
    field("wide", &WithFacts::wide, required, ranges::length);
  }
};

TEST(Fields, FactsOfFieldsDoNotChangeTheHash) { EXPECT_EQ(hash(WithFacts()), hash(Inner())); }

TEST(Fields, FactsMayBeInAnyOrder) {
  constexpr FieldFacts facts = facts_of("how far", degrees, ranges::length, added);
  EXPECT_EQ(facts.description, "how far");
  EXPECT_EQ(facts.range->high, 1e5);
  EXPECT_TRUE(facts.is_degrees && facts.is_added);
  EXPECT_FALSE(facts.is_required || facts.count);
}

TEST(Fields, TheUnitIsAtTheEndOfTheName) {
  EXPECT_EQ(unit_of("range_m"), "m");
  EXPECT_EQ(unit_of("v_m_s_max"), "m/s");
  EXPECT_EQ(unit_of("steering_rate_deg_s"), "deg/s");
  EXPECT_EQ(unit_of("w_acceleration_rad_s2"), "rad/s2");
  EXPECT_EQ(unit_of("slips_per_m"), "");
  EXPECT_EQ(unit_of("beams"), "");
}

}  // namespace
}  // namespace waitpoint
