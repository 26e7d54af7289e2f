// SPDX-License-Identifier: BSD-3-Clause
// Reads a file of rules, by recursive descent. The grammar:
//
//   rules      = { ("cost" | "period") time ";" } { "context" NAME "{" [ "when" ":" expression ";" ] { check } "}" }
//   check      = "check" NAME "{" condition { action } "}"
//   condition  = ("fail" | "never" | "always") ":" expression ";" | "exclusive" ":" patterns ";"
//   action     = "delay" ":" patterns "for" time ";" | "interrupt" ":" patterns "within" time ";"
//   expression = conjunction { "||" conjunction }
//   conjunction = operand { "&&" operand }
//   operand    = "!" operand | "(" expression ")" | "true" | "false"
//              | ("past" | "always" | "never") "(" expression ")" | "since" "(" expression "," expression ")"
//              | ("request" | "running" | "succeeded" | "failed") "(" pattern ")" | "duration" "(" pattern ")" ">" time
//              | "given" "(" POSTER ")" | "age" "(" POSTER ")" ">" time | FIELD [ RELATION NUMBER ]
//   patterns   = pattern { "," pattern }
//   pattern    = REQUEST [ "(" [ FIELD [ RELATION NUMBER ] { "," FIELD [ RELATION NUMBER ] } ] ")" ]
//   time       = NUMBER ("s" | "ms" | "us")
//
// A field without a relation is `!= 0`.
#pragma once

#include <string>
#include <string_view>

#include "modules/control/rules.hpp"

namespace waitpoint::control {

/// The rules in `contents`; `file` is for errors. BadInput with line and column.
Rules parse_rules(std::string_view contents, const std::string& file);

}  // namespace waitpoint::control
