// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/library/message_layout.hpp"

#include <gtest/gtest.h>

#include <cstring>

namespace waitpoint::nodes {
namespace {

// As roscpp gives the definition of a message with others within.
constexpr const char* definition =
    "# a comment\n"
    "uint8 LIMIT=3  # a constant\n"
    "Header header\n"
    "string name\n"
    "float32[] ranges\n"
    "int16[2] pair\n"
    "geometry_msgs/Point[] points\n"
    "duration left\n"
    "bool is_last\n"
    "================================================================================\n"
    "MSG: std_msgs/Header\n"
    "uint32 seq\n"
    "time stamp\n"
    "string frame_id\n"
    "================================================================================\n"
    "MSG: geometry_msgs/Point\n"
    "float64 x\n"
    "float64 y\n";

class Bytes {
 public:
  template <class T>
  Bytes& add(T value) {
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&value);
    all.insert(all.end(), bytes, bytes + sizeof value);
    return *this;
  }
  Bytes& add_text(const std::string& text) {
    add(static_cast<std::uint32_t>(text.size()));
    all.insert(all.end(), text.begin(), text.end());
    return *this;
  }

  std::vector<std::uint8_t> all;
};

std::vector<std::uint8_t> message() {
  Bytes bytes;
  bytes.add<std::uint32_t>(7).add<std::uint32_t>(12).add<std::uint32_t>(500'000'000).add_text("map");
  bytes.add_text("a name");
  bytes.add<std::uint32_t>(2).add(1.5F).add(2.5F);
  bytes.add<std::int16_t>(-3).add<std::int16_t>(4);
  bytes.add<std::uint32_t>(1).add(0.25).add(-8.0);
  bytes.add<std::int32_t>(-2).add<std::int32_t>(0);
  bytes.add<std::uint8_t>(1);
  return bytes.all;
}

TEST(MessageLayout, FindsNumbersOfEachKind) {
  const MessageLayout layout(definition);
  const std::vector<std::uint8_t> bytes = message();
  EXPECT_EQ(layout.value(bytes, "header.seq"), 7);
  EXPECT_EQ(layout.value(bytes, "header.stamp"), 12.5);
  EXPECT_EQ(layout.value(bytes, "ranges[1]"), 2.5);
  EXPECT_EQ(layout.value(bytes, "pair[0]"), -3);
  EXPECT_EQ(layout.value(bytes, "points[0].y"), -8);
  EXPECT_EQ(layout.value(bytes, "left"), -2);
  EXPECT_EQ(layout.value(bytes, "is_last"), 1);
}

TEST(MessageLayout, HasNoValueForWhatIsNoNumberOrNotThere) {
  const MessageLayout layout(definition);
  for (const char* const field : {"name", "header", "speed", "ranges[2]", "ranges", "LIMIT", ""})
    EXPECT_FALSE(layout.value(message(), field)) << field;
  std::vector<std::uint8_t> cut = message();
  cut.resize(30);
  EXPECT_FALSE(layout.value(cut, "is_last"));
}

}  // namespace
}  // namespace waitpoint::nodes
