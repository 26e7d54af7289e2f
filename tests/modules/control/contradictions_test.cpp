// SPDX-License-Identifier: BSD-3-Clause
// Contradictions of rules, each told in one line, and rules without one.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "modules/control/contradictions.hpp"
#include "modules/control/parser.hpp"

namespace waitpoint::control {
namespace {

std::string contradiction_of(const std::string& checks) {
  try {
    const Rules rules = parse_rules("context c {\n" + checks + "}", "r.ctl");
    check_contradictions(rules, Automaton(rules));
  } catch (const BadInput& bad) {
    return bad.what();
  }
  return "";
}

TEST(Contradictions, AreToldInOneLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"check a { fail: running(m.A) && m.p.f > 2 && m.p.f < 1; }",
       "r.ctl:2: column 7: check c.a: the condition can never hold"},
      {"check a { fail: running(m.A(x > 2)) && !running(m.A(x > 1)); }",
       "r.ctl:2: column 7: check c.a: the condition can never hold"},
      {"check a { fail: running(m.A) && past(m.p.f > 1 && !given(m.p)); }",
       "r.ctl:2: column 7: check c.a: the condition can never hold"},
      {"check a { fail: duration(m.A) > 2 s && !(duration(m.A) > 1 s); }",
       "r.ctl:2: column 7: check c.a: the condition can never hold"},
      {"check a { fail: running(m.A) || !running(m.A); }",
       "r.ctl:2: column 7: check c.a: the condition always holds: no request could be accepted"},
      {"check a { always: running(m.A); }",
       "r.ctl:2: column 7: check c.a: the condition holds while nothing runs: no request could be accepted"},
      {"check a { fail: m.p.f > 2; }",
       "r.ctl:2: column 7: check c.a: expected request(), running() or duration() in the condition, or activities to "
       "interrupt: the controller cannot prevent this state"},
      {"check a { fail: running(m.A); delay: m.B for 1 s; }",
       "r.ctl:2: column 38: check c.a never delays m.B: its condition does not depend on it"},
      {"check a { fail: running(m.A); }", "r.ctl:2: column 7: check c.a: no m.A can ever be accepted"},
      {"check a { fail: running(m.A(x > 2, x < 1)); }", "r.ctl:2: column 25: no input of m.A meets these comparisons"},
      // What each demands of the poster is the opposite of the other.
      {"check a { fail: running(m.A) && m.p.f > 1; }\ncheck other { fail: running(m.B); interrupt: m.B within 1 s; "
       "}\ncheck b { fail: running(m.A) && !(m.p.f > 1); }",
       "r.ctl:4: column 7: check c.b: demands the opposite of c.a: with both, no m.A can ever be accepted"},
      {"check a { fail: m.p.f > 1; interrupt: m.A within 1 s; }\ncheck b { fail: !(m.p.f > 1); interrupt: m.A within 1 "
       "s; }",
       "r.ctl:3: column 7: check c.b: demands the opposite of c.a: one of them fails even while nothing runs"},
      // Each waits for the other to run.
      {"check a { fail: running(m.A) && !running(m.B); }\ncheck b { fail: running(m.B) && !running(m.A); }",
       "r.ctl:3: column 7: check c.b: demands the opposite of c.a: with both, no m.A can ever be accepted"},
      // Needs the end of a request that needs this one's.
      {"check a { fail: request(m.A) && !past(succeeded(m.B)); }\ncheck b { fail: request(m.B) && "
       "!past(succeeded(m.A)); }",
       "r.ctl:3: column 7: check c.b: demands the opposite of c.a: with both, no m.A can ever be accepted"},
  };
  for (const auto& [checks, message] : cases) EXPECT_EQ(contradiction_of(checks), message) << checks;
}

// Together these conditions are too large for a diagram; what a single check says is still searched.
TEST(Contradictions, SingleContradictoryChecksAreFoundInLargeRules) {
  std::string checks;
  for (int i = 0; i < 45; ++i) {
    const auto text = [](int n) { return std::to_string(n); };
    checks += "check k" + text(i) + " { fail: running(m.A" + text(i) + ") && past(request(m.B" + text(i % 7) +
              ") && m.p.f" + text(i) + " > 1) && since(!running(m.C" + text(i) + "), running(m.A" + text(i * 7 % 45) +
              ")); }\n";
  }
  EXPECT_EQ(contradiction_of(checks), "");
  EXPECT_EQ(contradiction_of(checks + "check z { fail: running(m.A1) && m.p.f1 > 2 && m.p.f1 < 1; }"),
            "r.ctl:47: column 7: check c.z: the condition can never hold");
}

TEST(Contradictions, AreNotSeenWhereThereAreNone) {
  for (const char* checks : {
           "check a { exclusive: m.A, m.B; }",
           "check a { fail: request(m.B) && !past(succeeded(m.A)); }\ncheck b { exclusive: m.A, m.B; }",
           "check a { fail: running(m.A(x > 2)); }",  // forbids some inputs
           "check a { fail: running(m.A) && !running(m.B); }\ncheck b { fail: request(m.B) && m.p.f > 1; }",
           "check a { fail: duration(m.A) > 2 s; }",
           "check a { fail: m.p.f > 2; interrupt: m.A within 1 s; }",
           "check a { fail: running(m.A) && age(m.p) > 1 s; delay: m.A for 2 s; }",
           "check a { fail: running(m.A) && since(!succeeded(m.C), succeeded(m.B)); }",
       })
    EXPECT_EQ(contradiction_of(checks), "") << checks;
}

}  // namespace
}  // namespace waitpoint::control
