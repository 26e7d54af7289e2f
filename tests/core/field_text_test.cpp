// SPDX-License-Identifier: BSD-3-Clause
#include "core/field_text.hpp"

#include <gtest/gtest.h>

namespace waitpoint {
namespace {

enum class FieldTextMode : std::uint8_t { off, on };

struct FieldTextDevice {
  FieldTextMode mode = FieldTextMode::on;
  bool is_ready = true;
  Pose pose{1.5, -2, 0.1};
  std::array<double, 2> gains{0.25, 1e-9};
  Bounded<Point, 3> via;
  Duration period_ms = std::chrono::microseconds(2500);
  Time date;

  static void fields(auto field) {
    field("mode", &FieldTextDevice::mode);
    field("is_ready", &FieldTextDevice::is_ready);
    field("pose", &FieldTextDevice::pose);
    field("gains", &FieldTextDevice::gains);
    field("via", &FieldTextDevice::via);
    field("period_ms", &FieldTextDevice::period_ms);
    field("date", &FieldTextDevice::date);
  }
};

TEST(FieldText, IsADictionaryOfTheDeclaredFields) {
  FieldTextDevice device;
  device.via.push_back({3, 4});
  EXPECT_EQ(text_of(device),
            "mode 1 is_ready 1 pose {x 1.5 y -2 heading 0.1} gains {0.25 1e-09} via {{x 3 y 4}} period_ms 2.5 date "
            "0.000000000");
}

TEST(FieldText, ShapeHasTheFieldsWithTheirParts) {
  const FieldShape shape = shape_of<FieldTextDevice>();
  ASSERT_EQ(shape.parts.size(), 7u);
  EXPECT_EQ(shape.kind, FieldShape::Kind::record);
  EXPECT_EQ(shape.parts[0].kind, FieldShape::Kind::value);
  EXPECT_EQ(shape.parts[2].parts.at(2).name, "heading");
  EXPECT_EQ(shape.parts[4].kind, FieldShape::Kind::list);
  EXPECT_EQ(shape.parts[4].parts.at(0).kind, FieldShape::Kind::record);
}

}  // namespace
}  // namespace waitpoint
