// SPDX-License-Identifier: BSD-3-Clause
// Numbers of a value by the path of a field: each kind of field, what is absent, and what there is not.
#include <gtest/gtest.h>

#include "core/field_path.hpp"

namespace waitpoint {
namespace {

enum class Mode : std::uint8_t { slow, fast };

struct Inner {
  Pose pose{1, 2, 0.5};
  std::array<double, 2> gains{3, 4};
  static void fields(auto field) {
    field("pose", &Inner::pose);
    field("gains", &Inner::gains);
  }
};

struct Outer {
  Inner inner;
  Bounded<Point, 3> via;
  Mode mode = Mode::fast;
  bool is_on = true;
  Duration time = std::chrono::milliseconds(1500);
  std::int32_t count = -7;
  static void fields(auto field) {
    field("inner", &Outer::inner);
    field("via", &Outer::via);
    field("mode", &Outer::mode);
    field("is_on", &Outer::is_on);
    field("time", &Outer::time);
    field("count", &Outer::count, added);
  }
};

TEST(FieldPath, ReadsTheNumberOfEachKindOfField) {
  Outer value;
  value.via.push_back({8, 9});
  const std::pair<const char*, double> cases[] = {{"inner.pose.x", 1},  {"inner.pose.heading", 0.5},
                                                  {"inner.gains.1", 4}, {"via.size", 1},
                                                  {"via.0.y", 9},       {"mode", 1},
                                                  {"is_on", 1},         {"time", 1.5},
                                                  {"count", -7}};
  for (const auto& [path, expected] : cases) {
    double number = 0;
    EXPECT_EQ(read_number(value, path, number), FieldOutcome::number) << path;
    EXPECT_EQ(number, expected) << path;
  }
}

TEST(FieldPath, TellsAbsentElementsFromUnknownFields) {
  const Outer value;
  double number = 5;
  EXPECT_EQ(read_number(value, "via.2.x", number), FieldOutcome::absent);
  for (const char* path : {"", "inner", "inner.pose", "inner.pose.z", "inner.gains", "inner.gains.2", "inner.gains.-1",
                           "via", "via.3.x", "via.0", "via.2.z", "mode.x", "no"})
    EXPECT_EQ(read_number(value, path, number), FieldOutcome::unknown) << path;
  EXPECT_EQ(number, 5);
}

}  // namespace
}  // namespace waitpoint
