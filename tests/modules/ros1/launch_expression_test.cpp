// SPDX-License-Identifier: BSD-3-Clause
// Expressions of $(eval ...) have the values that Python gives them.
#include <gtest/gtest.h>

#include <map>

#include "modules/ros1/launch_expression.hpp"
#include "tests/modules/scenario/scenario_text.hpp"

namespace waitpoint::ros1 {
namespace {

std::string value_of(const std::string& expression) {
  const std::map<std::string, std::string> values = {
      {"sim", "true"}, {"number", "3"}, {"real", "0.5"}, {"word", "fast"}, {"none", ""}};
  return value_of_expression(expression,
                             [&](const std::vector<std::string>& words) -> std::string {
                               if (words.front() != "arg") return words.front() + std::to_string(words.size());
                               if (!values.contains(words.at(1))) throw BadInput("a.launch", 3, "no " + words.at(1));
                               return values.at(words.at(1));
                             },
                             {"a.launch", 3});
}

std::string complaint(const std::string& expression) {
  return scenario::message_of<BadInput>([&] { value_of(expression); });
}

TEST(LaunchExpression, Compares) {
  for (const char* holds : {"word == 'fast'", "word != \"slow\"", "number >= 3 and number < 4", "not (number > 3)",
                            "arg('sim')", "sim == True", "none == ''", "number == 3.0", "'3' != number", "'a' < 'b'",
                            "not not sim", "True or word", "1 <= 1", "sim == 1"})
    EXPECT_TRUE(value_of(holds) == "True") << holds;
  for (const char* fails : {"word == 'slow'", "number != 3", "not sim", "sim and false", "3 > number", "1.5 >= 2"})
    EXPECT_EQ(value_of(fails), "False") << fails;
}

TEST(LaunchExpression, Calculates) {
  EXPECT_EQ(value_of("2 * number + 1"), "7");
  EXPECT_EQ(value_of("1 - 2 - 3"), "-4");
  EXPECT_EQ(value_of("number / 2"), "1.5");
  EXPECT_EQ(value_of("4 / 2"), "2.0");
  EXPECT_EQ(value_of("-7 // 2"), "-4");
  EXPECT_EQ(value_of("-7 % 3"), "2");
  EXPECT_EQ(value_of("7.5 % -2"), "-0.5");
  EXPECT_EQ(value_of("-(number - real)"), "-2.5");
  EXPECT_EQ(value_of("100000 * 1.0"), "100000.0");
  EXPECT_EQ(value_of("1e16 * 1"), "1e+16");
  EXPECT_EQ(value_of("'a' + word + 'b'"), "afastb");
}

TEST(LaunchExpression, EvaluatesConditionals) {
  EXPECT_EQ(value_of("'x' if sim else 'y'"), "x");
  EXPECT_EQ(value_of("1 if number > 5 else 2 if number > 2 else 3"), "2");
  EXPECT_EQ(value_of("none or word"), "fast");
  EXPECT_EQ(value_of("none and word"), "");
}

TEST(LaunchExpression, CallsSubstitutions) {
  EXPECT_EQ(value_of("env('HOME')"), "env2");
  EXPECT_EQ(value_of("optenv('A', 'b') + dirname()"), "optenv3dirname1");
}

TEST(LaunchExpression, ReportsErrors) {
  EXPECT_EQ(complaint("1 +"), "a.launch:3: expected a value in the expression '1 +', found its end");
  EXPECT_EQ(complaint("(1"), "a.launch:3: expected ')' in the expression '(1', found its end");
  EXPECT_EQ(complaint("1 2"), "a.launch:3: expected the end in the expression '1 2', found '2'");
  EXPECT_EQ(complaint("'a"), "a.launch:3: expected a text in quotes, without '\\', in the expression ''a'");
  EXPECT_EQ(complaint("1 / 0"), "a.launch:3: expected values that have '/', and a result, in the expression '1 / 0'");
  for (const char* wrong : {"",
                            "1 // 0",
                            "1 % 0",
                            "9223372036854775807 + 1",
                            "1.0 * 1e308 * 10",
                            "'a' * 3",
                            "'a' - 'b'",
                            "1 < 'a'",
                            "1 if 2",
                            "arg(1)",
                            "arg('a' 'b')",
                            "eval('1')",
                            "1..2",
                            "x.y",
                            "[1]",
                            "__a__",
                            "a = 1",
                            "lambda: 0",
                            "1 < 2 < 3",
                            "-'a'",
                            ")",
                            "0x10"})
    EXPECT_NE(complaint(wrong), "") << wrong;
}

TEST(LaunchExpression, BoundsNestingAndLength) {
  EXPECT_EQ(complaint(std::string(5000, '1')), "a.launch:3: expected an expression of at most 4096 characters");
  EXPECT_NE(complaint(std::string(2000, '(')).find("expected at most 50 levels"), std::string::npos);
  EXPECT_EQ(value_of(std::string(4000, '-') + "1"), "1");
}

}  // namespace
}  // namespace waitpoint::ros1
