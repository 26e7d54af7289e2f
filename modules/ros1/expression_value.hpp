// SPDX-License-Identifier: BSD-3-Clause
// Values of the expressions in launch files, with the operations of Python.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

namespace waitpoint::ros1 {

using ExpressionValue = std::variant<bool, std::int64_t, double, std::string>;

/// A text as a number or truth value if it looks like one, as of a parameter of type "auto".
ExpressionValue value_of_text(const std::string& text);
/// "True", "3", "0.5", or a text itself.
std::string text_of(const ExpressionValue& value);
/// False for False, 0 and "".
bool is_true(const ExpressionValue& value);

bool is_equal(const ExpressionValue& a, const ExpressionValue& b);
/// `op` is one of <, <=, >, >=. False if the two have no order.
bool compare(const ExpressionValue& a, std::string_view op, const ExpressionValue& b, bool& result);
/// `op` is one of +, -, *, /, //, %. False for a division by 0, an integer beyond 64 bits, a text of more
/// than 1 MiB, and values that do not have `op`.
bool calculate(const ExpressionValue& a, std::string_view op, const ExpressionValue& b, ExpressionValue& result);

}  // namespace waitpoint::ros1
