// SPDX-License-Identifier: BSD-3-Clause
// Compiled rules against a naive evaluation: random conditions over random histories, in which the temporal operators
// are evaluated by their definition over all steps.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "core/random.hpp"
#include "modules/control/automaton.hpp"
#include "modules/control/parser.hpp"

namespace waitpoint::control {
namespace {

/// A request with an input x, and what happens to it in a step.
struct Instance {
  int request;
  double x;
};
struct Step {
  std::vector<Instance> running;
  std::optional<Instance> requested, succeeded, failed;
  bool is_given = false;
  double field = 0;  // of the poster, if it is given
  int age_s = 0;
};
using History = std::vector<Step>;

/// A condition as text, and its naive meaning at step `t`.
struct Condition {
  std::string text;
  std::function<bool(const History& history, std::size_t t)> holds;
};

constexpr const char* relation_texts[] = {"<", "<=", "==", "!=", ">=", ">"};

bool naive(int relation, double a, double b) {
  switch (relation) {
    case 0: return a < b;
    case 1: return a <= b;
    case 2: return a == b;
    case 3: return a < b || a > b;
    case 4: return a >= b;
    default: return a > b;
  }
}

class Generator {
 public:
  explicit Generator(std::uint64_t seed) : random_(seed, "test", "conditions") {}

  int below(int n) { return static_cast<int>(random_.uniform(draws_++) * n); }

  Condition condition(int depth) {
    if (depth == 0) return leaf();
    Condition a = condition(depth - 1);
    switch (below(7)) {
      case 0: return {"!(" + a.text + ")", [a](const History& h, std::size_t t) { return !a.holds(h, t); }};
      case 1:
        return {"past(" + a.text + ")", [a](const History& h, std::size_t t) {
                  for (std::size_t i = 0; i <= t; ++i)
                    if (a.holds(h, i)) return true;
                  return false;
                }};
      case 2:
        return {"always(" + a.text + ")", [a](const History& h, std::size_t t) {
                  for (std::size_t i = 0; i <= t; ++i)
                    if (!a.holds(h, i)) return false;
                  return true;
                }};
      case 3:
        return {"never(" + a.text + ")", [a](const History& h, std::size_t t) {
                  for (std::size_t i = 0; i <= t; ++i)
                    if (a.holds(h, i)) return false;
                  return true;
                }};
      default: break;
    }
    Condition b = condition(depth - 1);
    switch (below(3)) {
      case 0:
        return {"(" + a.text + " && " + b.text + ")",
                [a, b](const History& h, std::size_t t) { return a.holds(h, t) && b.holds(h, t); }};
      case 1:
        return {"(" + a.text + " || " + b.text + ")",
                [a, b](const History& h, std::size_t t) { return a.holds(h, t) || b.holds(h, t); }};
      default:
        return {"since(" + a.text + ", " + b.text + ")", [a, b](const History& h, std::size_t t) {
                  for (std::size_t begin = 0; begin <= t; ++begin) {
                    if (!b.holds(h, begin)) continue;
                    bool lasts = true;
                    for (std::size_t i = begin + 1; i <= t; ++i) lasts = lasts && a.holds(h, i);
                    if (lasts) return true;
                  }
                  return false;
                }};
    }
  }

  Step step() {
    Step step;
    while (below(3) == 0) step.running.push_back(instance());
    switch (below(4)) {
      case 0: step.requested = instance(); break;
      case 1: step.succeeded = instance(); break;
      case 2: step.failed = instance(); break;
      default: break;
    }
    step.is_given = below(4) > 0;
    step.field = below(10) == 0 ? std::numeric_limits<double>::quiet_NaN() : below(4);
    step.age_s = below(4);
    return step;
  }

 private:
  Instance instance() { return {below(2), static_cast<double>(below(4))}; }

  Condition leaf() {
    const int kind = below(7), relation = below(6), number = below(4);
    const std::string comparison = std::string(" ") + relation_texts[relation] + " " + std::to_string(number);
    if (kind == 0) {
      return {"m.p.f" + comparison, [=](const History& h, std::size_t t) {
                return h[t].is_given && !std::isnan(h[t].field) && naive(relation, h[t].field, number);
              }};
    }
    if (kind == 1) return {"given(m.p)", [](const History& h, std::size_t t) { return h[t].is_given; }};
    if (kind == 2)
      return {"age(m.p) > " + std::to_string(number) + " s",
              [=](const History& h, std::size_t t) { return !h[t].is_given || h[t].age_s > number; }};
    const int request = below(2);
    const bool has_input = below(2) == 0;
    const auto meets = [=](const Instance& instance) {
      return instance.request == request && (!has_input || naive(relation, instance.x, number));
    };
    const std::string pattern = std::string(request == 0 ? "m.A" : "m.B") + (has_input ? "(x" + comparison + ")" : "");
    if (kind == 3)
      return {"running(" + pattern + ")", [=](const History& h, std::size_t t) {
                return std::any_of(h[t].running.begin(), h[t].running.end(), meets);
              }};
    const auto event = [&](const char* name, std::optional<Instance> Step::*member) -> Condition {
      return {std::string(name) + "(" + pattern + ")",
              [=](const History& h, std::size_t t) { return h[t].*member && meets(*(h[t].*member)); }};
    };
    if (kind == 4) return event("request", &Step::requested);
    if (kind == 5) return event("succeeded", &Step::succeeded);
    return event("failed", &Step::failed);
  }

  RandomStream random_;
  std::uint64_t draws_ = 0;
};

bool meets(const RequestPattern& pattern, const Instance& instance) {
  if (pattern.request != (instance.request == 0 ? "A" : "B")) return false;
  return std::all_of(pattern.inputs.begin(), pattern.inputs.end(),
                     [&](const Comparison& input) { return holds(input.relation, instance.x, input.number); });
}

/// The value that the controller gives a predicate.
bool value_of(const Predicate& predicate, const Step& step, const Automaton& automaton) {
  const auto met = [&](const auto& instance) { return meets(automaton.patterns()[predicate.pattern], instance); };
  const bool is_present = step.is_given && !std::isnan(step.field);
  switch (predicate.kind) {
    case Predicate::Kind::requested: return step.requested && met(*step.requested);
    case Predicate::Kind::succeeded: return step.succeeded && met(*step.succeeded);
    case Predicate::Kind::failed: return step.failed && met(*step.failed);
    case Predicate::Kind::running: return std::any_of(step.running.begin(), step.running.end(), met);
    case Predicate::Kind::present: return is_present;
    case Predicate::Kind::greater: return is_present && step.field > predicate.number;
    case Predicate::Kind::greater_equal: return is_present && step.field >= predicate.number;
    case Predicate::Kind::given: return step.is_given;
    case Predicate::Kind::aged: return !step.is_given || Duration(std::chrono::seconds(step.age_s)) > predicate.time;
    default: return false;
  }
}

TEST(Automaton, AgreesWithANaiveEvaluationOfRandomConditions) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Generator generator(seed);
    const Condition condition = generator.condition(static_cast<int>(seed % 5));
    const std::string text = "context c { check k { fail: " + condition.text + "; } }";
    const Automaton automaton(parse_rules(text, "random"));
    std::vector<bool> values = automaton.initial_values();
    History history;
    for (std::size_t t = 0; t < 12; ++t) {
      history.push_back(generator.step());
      for (std::size_t v = 0; v < values.size(); ++v)
        if (automaton.predicates()[v].kind != Predicate::Kind::memory)
          values[v] = value_of(automaton.predicates()[v], history[t], automaton);
      ASSERT_EQ(automaton.is_forbidden(0, values), condition.holds(history, t)) << text << " at step " << t;
      automaton.remember(values);
    }
  }
}

TEST(Automaton, ImplicationsOfPatternsAgreeWithTheInputsThatMeetThem) {
  Generator generator(1);
  for (int i = 0; i < 2000; ++i) {
    RequestPattern a{"m", "A", {}, {}}, b = a;
    for (RequestPattern* pattern : {&a, &b})
      while (generator.below(2) == 0)
        pattern->inputs.push_back({"x", static_cast<Relation>(generator.below(6)), double(generator.below(3)), {}});
    bool is_implied = true, is_met = false;
    for (double x = -1; x <= 3; x += 0.5) {
      const bool meets_a = a.inputs.empty() || meets(a, {0, x});
      is_met = is_met || meets_a;
      is_implied = is_implied && (!meets_a || meets(b, {0, x}));
    }
    // A request without the field meets the empty pattern alone.
    if (a.inputs.empty()) is_implied = b.inputs.empty();
    EXPECT_EQ(implies(a, b), is_implied || b.inputs.empty());
    EXPECT_EQ(is_empty(a), !is_met);
  }
}

TEST(Automaton, SharesTheMemoryOfEqualOperators) {
  const Automaton automaton(parse_rules(
      "context c { check k { fail: past(running(m.A)) && since(true, running(m.A)) && !never(running(m.A)); } }", "r"));
  EXPECT_EQ(automaton.memory().size(), 1U);
}

TEST(Automaton, ARequestRaisesWhatBecomesTrueByIt) {
  const Rules rules = parse_rules("context c { check k { fail: running(m.A(x > 1)) && !running(m.B); } }", "r");
  const Automaton automaton(rules);
  const RequestPattern b{"m", "B", {}, {}};
  EXPECT_TRUE(automaton.raises(0, 0));
  EXPECT_FALSE(automaton.raises(0, automaton.index_of(b)));
}

// A condition of 2^14 nodes, in an order of the variables that is bad for it: what requests raise needs the rest. A
// check that would not be enforced for want of nodes is refused.
TEST(Automaton, RefusesRulesWhoseSearchForRaisingRequestsNeedsTooManyNodes) {
  std::string order, pairs;
  for (int i = 0; i < 14; ++i) {
    const std::string a = "m.p.a > " + std::to_string(i), b = "m.p.b > " + std::to_string(i);
    order += " || " + a;
    pairs += (pairs.empty() ? "" : " || ") + ("(" + a) + " && " + b + ")";
  }
  const std::string filler = "check order { fail: running(m.B) && (m.p.a > 99" + order +
                             "); }\ncheck pairs { fail: running(m.B(x > 1)) && (" + pairs + "); }\n";
  try {
    const Automaton automaton(parse_rules("context c {\n" + filler + "check k { fail: running(m.A); } }", "r"));
    EXPECT_TRUE(automaton.raises(2, automaton.index_of({"m", "A", {}, {}})));
    FAIL() << "the rules have come to need fewer nodes";
  } catch (const BadInput& error) {
    EXPECT_EQ(std::string(error.what()), "r:3: column 7: expected rules of at most 131072 nodes when compiled");
  }
}

}  // namespace
}  // namespace waitpoint::control
