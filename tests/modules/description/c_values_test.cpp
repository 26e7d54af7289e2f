// SPDX-License-Identifier: BSD-3-Clause
// Values of C become values with declared fields, and back, without what is no part of the value.
#include "modules/genom/c_values.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

namespace waitpoint::genom {
namespace {

enum Colour { red, green };
struct Inner {
  float ratio;
};
struct Value {
  char name[8];
  short table[2][2];
  Colour colour;
  Inner inner[2];
};

struct InnerFields {
  using CType = Inner;
  double ratio{};
  void from(const Inner& c) { from_c(ratio, c.ratio); }
  void to(Inner& c) const { to_c(c.ratio, ratio); }
};
struct ValueFields {
  std::array<char, 8> name{};
  std::array<std::array<std::int16_t, 2>, 2> table{};
  std::uint32_t colour{};
  std::array<InnerFields, 2> inner{};
};

TEST(CValues, BecomeFieldsAndBack) {
  const Value value{"mast", {{1, 2}, {3, 4}}, green, {{0.5F}, {0.25F}}};
  ValueFields fields;
  from_c(fields.table, value.table);
  from_c(fields.colour, value.colour);
  from_c(fields.inner, value.inner);
  EXPECT_EQ(fields.table[1][0], 3);
  EXPECT_EQ(fields.colour, 1U);
  EXPECT_EQ(fields.inner[1].ratio, 0.25);
  Value back{};
  to_c(back.table, fields.table);
  to_c(back.colour, fields.colour);
  to_c(back.inner, fields.inner);
  EXPECT_EQ(std::memcmp(back.table, value.table, sizeof value.table), 0);
  EXPECT_EQ(back.colour, green);
  EXPECT_EQ(back.inner[1].ratio, 0.25F);
}

TEST(CValues, TextsEndAtTheNul) {
  char name[8];
  std::memset(name, 'x', sizeof name);
  std::memcpy(name, "ab", 3);
  std::array<char, 8> text{};
  from_c(text, name);
  EXPECT_EQ(text, (std::array<char, 8>{'a', 'b'}));
  std::memset(name, 'x', sizeof name);
  from_c(text, name);
  EXPECT_EQ(text[7], '\0') << "without a NUL the last letter is one";
}

TEST(CValues, AnyKindIsCopied) {
  const Value from{"mast", {{1, 2}, {3, 4}}, green, {{0.5F}, {0.25F}}};
  Value to{};
  copy_c(to.table, from.table);
  copy_c(to.name, from.name);
  copy_c(to.colour, from.colour);
  EXPECT_STREQ(to.name, "mast");
  EXPECT_EQ(to.table[1][1], 4);
}

}  // namespace
}  // namespace waitpoint::genom
