// SPDX-License-Identifier: BSD-3-Clause
// C's constant expressions of integers: array sizes, values of enumerators, numbers of a description, conditions of
// #if.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "modules/description/token_stream.hpp"

namespace waitpoint::description {

/// The value of a name, or of `sizeof (` and `defined`, after which the tokens were taken; nothing if unknown.
using NameValue = std::function<std::optional<std::int64_t>(TokenStream& tokens, const Token& name)>;

/// Takes an expression with C's operators and precedences, of 64-bit integers. An unknown name, an overflow or a
/// division by zero is BadInput.
std::int64_t constant_expression(TokenStream& tokens, const NameValue& value_of);

}  // namespace waitpoint::description
