// SPDX-License-Identifier: BSD-3-Clause
// The language of rules: what is read, and the place of each error.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "modules/control/parser.hpp"

namespace waitpoint::control {
namespace {

using namespace std::chrono_literals;

std::string syntax_error(std::string_view text) {
  try {
    parse_rules(text, "r.ctl");
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

TEST(Parser, ReadsContextsChecksAndActions) {
  const Rules rules = parse_rules(R"(# a comment
cost 50 us;
period 0.2 s;
context mast {
  when: !mast.state.broken;
  check stowed {
    fail: running(ndd.GoTo(via.size > 2, via.0.x <= -1.5)) && mast.state.height_m > 0;
    delay: ndd.GoTo for 20 s;
    interrupt: mast.Deploy, mast.Turn(fast) within 500 ms;
  }
  check known { always: since(true, succeeded(pom.SetPos)) || age(pom.position) > 1 s; }
}
context base { check one { exclusive: a.A, a.B, a.C; } }
)",
                                  "r.ctl");
  EXPECT_EQ(rules.cost, Duration(50us));
  EXPECT_EQ(rules.period, Duration(200ms));
  ASSERT_EQ(rules.checks.size(), 3U);
  const Check& stowed = rules.checks[0];
  EXPECT_EQ(stowed.name, "mast.stowed");
  EXPECT_EQ(stowed.place.line, 6);
  EXPECT_EQ(stowed.place.column, 9);
  ASSERT_EQ(stowed.forbidden.kind, Expression::Kind::conjunction);
  EXPECT_EQ(stowed.forbidden.operands[0].kind, Expression::Kind::negation);
  const Expression& fail = stowed.forbidden.operands[1];
  ASSERT_EQ(fail.operands.size(), 2U);
  EXPECT_EQ(fail.operands[0].pattern.module, "ndd");
  EXPECT_EQ(fail.operands[0].pattern.inputs[1].path, "via.0.x");
  EXPECT_EQ(fail.operands[0].pattern.inputs[1].relation, Relation::less_equal);
  EXPECT_EQ(fail.operands[0].pattern.inputs[1].number, -1.5);
  EXPECT_EQ(fail.operands[1].comparison.path, "mast.state.height_m");
  EXPECT_EQ(stowed.delay_max, Duration(20s));
  ASSERT_EQ(stowed.interrupted.size(), 2U);
  EXPECT_EQ(stowed.interrupted[1].inputs[0].relation, Relation::not_equal);
  EXPECT_EQ(stowed.interruption_max, Duration(500ms));
  EXPECT_EQ(rules.checks[1].name, "mast.known");
  EXPECT_EQ(rules.checks[2].forbidden.operands.size(), 3U);  // pairs
}

TEST(Parser, NamesLineAndColumnOfAnError) {
  const std::vector<std::pair<std::string_view, std::string_view>> cases = {
      {"contxt a {}", "r.ctl:1: column 1: expected a context, found 'contxt', did you mean 'context'?"},
      {"context a {", "r.ctl:1: column 12: expected a check or '}', found the end of the file"},
      {"context a {}\ncontext a {}", "r.ctl:2: column 9: expected a name that is not given twice, found 'a'"},
      {"context a.b {}", "r.ctl:1: column 9: expected the name of a context, found 'a.b'"},
      {"context a {\n check b { forbid: true; }}",
       "r.ctl:2: column 12: expected fail, never, always or exclusive, found 'forbid'"},
      {"context a { check b { fail: running(ndd); } }",
       "r.ctl:1: column 37: expected a request, such as ndd.GoTo, found 'ndd'"},
      {"context a { check b { fail: mast.height > 1; } }",
       "r.ctl:1: column 29: expected an expression, such as running(ndd.GoTo) or a poster's field, found "
       "'mast.height'"},
      {"context a { check b { fail: duration(a.B) < 1 s; } }", "r.ctl:1: column 43: expected '>', found '<'"},
      {"context a { check b { fail: age(a.b) > 1 m; } }",
       "r.ctl:1: column 42: expected s, ms or us after a time, found 'm'"},
      {"context a { check b { fail: a.b.c > 1.2.3; } }", "r.ctl:1: column 37: expected a number, found '1.2.3'"},
      {"context a { check b { fail: a.b.c > x; } }", "r.ctl:1: column 37: expected a number, found 'x'"},
      {"context a { check b { fail: true }", "r.ctl:1: column 34: expected ';', found '}'"},
      {"context a { check b { fail: true; delay: a.B for 1 s; delay: a.B for 1 s; } }",
       "r.ctl:1: column 55: expected one such action in a check, found 'delay'"},
      {"context a { check b { exclusive: a.B; } }",
       "r.ctl:1: column 37: expected ',' and a second request that excludes the first, found ';'"},
      {"cost 1 us; period 1 s; cost 1 us;", "r.ctl:1: column 24: expected one cost in a file"},
      {"period 1 s;\nperiod 1 s;", "r.ctl:2: column 1: expected one period in a file"},
      {"context a { check b { exclusive: a.B(x > 1), a.B; } }",
       "r.ctl:1: column 46: expected requests that exclude each other: one a.B can be both"},
      {"period 0 s;", "r.ctl:1: column 1: expected a period above 0"},
      {"cost -1 s;", "r.ctl:1: column 6: expected a time from 0 to 1e9 s, found '-1'"},
      {"cost 1 s; @", "r.ctl:1: column 11: expected a name, a number or a sign, found '@'"},
      {"\x01", "r.ctl:1: column 1: expected a name, a number or a sign, found byte 1"},
  };
  for (const auto& [text, message] : cases) EXPECT_EQ(syntax_error(text), message);
}

TEST(Parser, BoundsNestingAndSize) {
  const std::string deep =
      "context a { check b { fail: " + std::string(200, '(') + "true" + std::string(200, ')') + "; } }";
  EXPECT_NE(syntax_error(deep).find("expected at most 100 nested expressions"), std::string::npos);
  std::string wide = "context a { check b { fail: true";
  for (int i = 0; i < 1000; ++i) wide += " || true";
  EXPECT_NE(syntax_error(wide + "; } }").find("expected at most 1000 operands in a file"), std::string::npos);
}

}  // namespace
}  // namespace waitpoint::control
