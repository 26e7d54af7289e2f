// SPDX-License-Identifier: BSD-3-Clause
// Values of ROS's parameters: the words of YAML 1.1.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "modules/scenario/parameter_value.hpp"

namespace waitpoint::scenario {
namespace {

nlohmann::json value_of(const std::string& text) { return parameter_value(parse_yaml(text, "p.yaml")); }

TEST(ParameterValue, HasTheTypeOfItsWord) {
  EXPECT_EQ(value_of(R"([true, Yes, ON, false, "no", n, off])").dump(), R"([true,true,true,false,"no","n",false])");
  EXPECT_EQ(value_of("[12, -3, +4, 1_000, 0x1F, 0b101, 017, 0, -0x10, 1:30, 089, 0x, _1]").dump(),
            R"([12,-3,4,1000,31,5,15,0,-16,"1:30","089","0x","_1"])");
  EXPECT_EQ(value_of("[1.5, -.5, 1., 1.0e+3, 1.0e3, 1e3, '2.5', 1.2.3, ., 1.5e]").dump(),
            R"([1.5,-0.5,1.0,1000.0,"1.0e3","1e3","2.5","1.2.3",".","1.5e"])");
  EXPECT_TRUE(std::isinf(value_of("-.inf").get<double>()));
  EXPECT_TRUE(std::isnan(value_of(".NaN").get<double>()));
  EXPECT_EQ(value_of("{a: {b: ~}, c: Null}").dump(), R"({"a":{"b":null},"c":null})");
  EXPECT_TRUE(value_of("").is_null());
}

TEST(ParameterValue, ReadsAngles) {
  EXPECT_DOUBLE_EQ(value_of("deg(90)").get<double>(), 1.5707963267948966);
  EXPECT_DOUBLE_EQ(value_of("rad(-2*pi)").get<double>(), -6.283185307179586);
  EXPECT_EQ(value_of("'rad(1)'"), "rad(1)");
  EXPECT_EQ(value_of("rad(1) or so"), "rad(1) or so");
  EXPECT_THROW(value_of("rad(tau)"), BadInput);
  EXPECT_THROW(value_of("rad('x')"), BadInput);
}

TEST(ParameterValue, RefusesNumbersBeyondTheirType) {
  EXPECT_THROW(value_of("99999999999999999999"), BadInput);
  EXPECT_THROW(value_of("0xFFFFFFFFFFFFFFFF"), BadInput);
  EXPECT_THROW(value_of("1.0e+999"), BadInput);
  EXPECT_EQ(value_of("2147483647:59:59"), "2147483647:59:59");
}

}  // namespace
}  // namespace waitpoint::scenario
