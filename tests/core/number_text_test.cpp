// SPDX-License-Identifier: BSD-3-Clause
#include "core/number_text.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cstdint>
#include <string>

namespace waitpoint {
namespace {

TEST(NumberText, ReadsTheNearestDouble) {
  double number = 0;
  for (const auto& [text, value] : {std::pair("0.1", 0x1.999999999999ap-4),
                                    {"-2.5e3", -2500.0},
                                    {".5", 0.5},
                                    {"5.", 5.0},
                                    {"9007199254740993", 9007199254740992.0},
                                    {"2.2250738585072011e-308", 0x1.ffffffffffffep-1023},
                                    {"1E+2", 100.0},
                                    {"4.9406564584124654e-324", 0x1p-1074}}) {
    EXPECT_TRUE(parse_number(text, number)) << text;
    EXPECT_EQ(number, value) << text;
  }
}

TEST(NumberText, RefusesWhatIsNoDecimalAndLeavesTheNumber) {
  for (const char* text :
       {"", " 1", "1 ", "+1", "1,5", "0x10", "inf", "nan", "-inf", "1e", "1e400", "-", ".", "1.5m", "--1"}) {
    double number = 7;
    EXPECT_FALSE(parse_number(text, number)) << text;
    EXPECT_EQ(number, 7) << text;
  }
}

TEST(NumberText, HoldsIntegersToTheirType) {
  std::int64_t number = 7;
  EXPECT_TRUE(parse_number("-9223372036854775808", number));
  EXPECT_EQ(number, INT64_MIN);
  for (const char* text : {"", "9223372036854775808", "1.0", " 1", "+1"})
    EXPECT_FALSE(parse_number(text, number)) << text;
  std::uint8_t small = 0;
  EXPECT_TRUE(parse_number("255", small));
  EXPECT_FALSE(parse_number("256", small));
  EXPECT_EQ(small, 255);
}

TEST(NumberText, NoLocaleIsAsked) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) {
    if (std::setlocale(LC_ALL, name) == nullptr) continue;
    double number = 0;
    EXPECT_TRUE(parse_number("1.5", number)) << name;
    EXPECT_EQ(number, 1.5) << name;
  }
  std::setlocale(LC_ALL, before.c_str());
}

}  // namespace
}  // namespace waitpoint
