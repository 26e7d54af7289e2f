// SPDX-License-Identifier: BSD-3-Clause
// Expressions of $(eval ...): the part of Python's that launch files use for conditions.
//
//   or, and, not, A if CONDITION else B
//   ==, !=, <, <=, >, >=               of two numbers or two texts; others are unequal, and have no order
//   +, -, *, /, //, %                  of numbers; + joins texts
//   numbers, 'texts', "texts", True, False, true, false
//   NAME, arg('NAME')                  the value of an argument: a number or a truth value if it looks like one
//   env('NAME'), optenv('NAME', 'X'), find('PACKAGE'), anon('WORD'), dirname()
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/location.hpp"

namespace waitpoint::ros1 {

/// The value of a substitution by its words: {"arg", "NAME"}.
using SubstitutionCall = std::function<std::string(const std::vector<std::string>& words)>;

/// The expression's value as text: "True", "3", "0.5". All of its parts are evaluated. BadInput at `written` for
/// another expression or one of more than 4096 characters, and for results as of expression_value.hpp.
std::string value_of_expression(std::string_view expression, const SubstitutionCall& call, const Location& written);

}  // namespace waitpoint::ros1
