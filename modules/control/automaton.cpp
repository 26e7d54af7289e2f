// SPDX-License-Identifier: BSD-3-Clause
#include "modules/control/automaton.hpp"

#include <algorithm>

namespace waitpoint::control {
namespace {

bool is_equal(const Comparison& a, const Comparison& b) {
  return a.path == b.path && a.relation == b.relation && a.number == b.number;
}

bool is_equal(const RequestPattern& a, const RequestPattern& b) {
  return is_same_request(a, b) && std::equal(a.inputs.begin(), a.inputs.end(), b.inputs.begin(), b.inputs.end(),
                                             [](const auto& x, const auto& y) { return is_equal(x, y); });
}

bool is_equal(const Predicate& a, const Predicate& b) {
  return a.kind == b.kind && a.pattern == b.pattern && a.poster == b.poster && a.path == b.path &&
         a.number == b.number && a.time == b.time;
}

}  // namespace

Automaton::Automaton(const Rules& rules) {
  for (const Check& check : rules.checks) {
    forbidden_.push_back(compile(check.forbidden));
    for (const auto* patterns : {&check.delayed, &check.interrupted})
      for (const RequestPattern& each : *patterns) pattern(each);
    expect_room(rules, check);
  }
  for (const RequestPattern& p : patterns_)
    for (std::vector<bool>& implied = implied_.emplace_back(); const RequestPattern& q : patterns_)
      implied.push_back(is_same_request(p, q) && control::implies(p, q));
  for (std::size_t i = 0; i < checks(); ++i) {
    find_raising(i);
    expect_room(rules, rules.checks[i]);
  }
}

void Automaton::expect_room(const Rules& rules, const Check& check) const {
  if (diagrams_.is_full())
    throw bad(rules.file, check.place,
              "expected rules of at most " + std::to_string(DecisionDiagrams::nodes_max) + " nodes when compiled");
}

// The condition becomes true with the predicate of such a request.
void Automaton::find_raising(std::size_t check) {
  const Node forbidden = forbidden_[check];
  std::vector<bool>& raises = raises_.emplace_back();
  for (std::size_t p = 0; p < patterns_.size(); ++p) {
    DecisionDiagrams::Fixed with, without;
    for (std::size_t v = 0; v < predicates_.size(); ++v) {
      const Predicate::Kind kind = predicates_[v].kind;
      if (kind == Predicate::Kind::succeeded || kind == Predicate::Kind::failed || !is_of(predicates_[v], p)) continue;
      with.emplace(static_cast<std::uint32_t>(v), true);
      without.emplace(static_cast<std::uint32_t>(v), false);
    }
    const Node before = diagrams_.restricted(forbidden, without), after = diagrams_.restricted(forbidden, with);
    raises.push_back(diagrams_.conjunction(after, diagrams_.negation(before)) != DecisionDiagrams::no);
  }
}

void Automaton::remember(std::vector<bool>& values) const {
  std::vector<bool> next;
  for (const Memory& bit : memory_) next.push_back(diagrams_.evaluate(bit.next, values));
  for (std::size_t i = 0; i < memory_.size(); ++i) values[memory_[i].variable] = next[i];
}

std::size_t Automaton::index_of(const RequestPattern& pattern) const {
  const auto found = find(pattern);
  WAITPOINT_CHECK(found != patterns_.end(), "a pattern is not of the rules");
  return static_cast<std::size_t>(found - patterns_.begin());
}

std::vector<RequestPattern>::const_iterator Automaton::find(const RequestPattern& pattern) const {
  return std::find_if(patterns_.begin(), patterns_.end(), [&](const auto& each) { return is_equal(each, pattern); });
}

std::size_t Automaton::pattern(const RequestPattern& pattern) {
  if (find(pattern) == patterns_.end()) patterns_.push_back(pattern);
  return index_of(pattern);
}

Automaton::Node Automaton::predicate(const Predicate& predicate) {
  auto found = std::find_if(predicates_.begin(), predicates_.end(),
                            [&](const Predicate& each) { return is_equal(each, predicate); });
  if (found == predicates_.end()) found = predicates_.insert(found, predicate);
  return diagrams_.variable(static_cast<std::size_t>(found - predicates_.begin()));
}

Automaton::Node Automaton::of_request(Predicate::Kind kind, const Expression& expression) {
  Predicate of{.kind = kind, .pattern = pattern(expression.pattern), .place = expression.place};
  if (kind == Predicate::Kind::lasting) of.time = expression.time;
  return predicate(of);
}

Automaton::Node Automaton::compile(const Expression& e) {
  const auto all = [&](Node start, Node (DecisionDiagrams::*join)(Node, Node)) {
    for (const Expression& operand : e.operands) start = (diagrams_.*join)(start, compile(operand));
    return start;
  };
  const auto past = [&](Node operand) { return since(DecisionDiagrams::yes, operand); };
  const auto of_poster = [&](Predicate::Kind kind) {
    return predicate({.kind = kind, .poster = e.poster, .time = e.time, .place = e.place});
  };
  switch (e.kind) {
    case Expression::Kind::constant: return e.truth ? DecisionDiagrams::yes : DecisionDiagrams::no;
    case Expression::Kind::requested: return of_request(Predicate::Kind::requested, e);
    case Expression::Kind::running: return of_request(Predicate::Kind::running, e);
    case Expression::Kind::succeeded: return of_request(Predicate::Kind::succeeded, e);
    case Expression::Kind::failed: return of_request(Predicate::Kind::failed, e);
    case Expression::Kind::lasting: return of_request(Predicate::Kind::lasting, e);
    case Expression::Kind::comparison: return compile(e.comparison);
    case Expression::Kind::given: return of_poster(Predicate::Kind::given);
    case Expression::Kind::aged: return of_poster(Predicate::Kind::aged);
    case Expression::Kind::negation: return diagrams_.negation(compile(e.operands[0]));
    case Expression::Kind::conjunction: return all(DecisionDiagrams::yes, &DecisionDiagrams::conjunction);
    case Expression::Kind::disjunction: return all(DecisionDiagrams::no, &DecisionDiagrams::disjunction);
    case Expression::Kind::past: return past(compile(e.operands[0]));
    case Expression::Kind::never: return diagrams_.negation(past(compile(e.operands[0])));
    case Expression::Kind::always: return diagrams_.negation(past(diagrams_.negation(compile(e.operands[0]))));
    case Expression::Kind::since: break;
  }
  const Node lasting = compile(e.operands[0]), begin = compile(e.operands[1]);
  return since(lasting, begin);
}

// Only > and >=, and whether there is a value, are predicates: their orders are known (contradictions.cpp).
Automaton::Node Automaton::compile(const Comparison& comparison) {
  const std::size_t poster_end = comparison.path.find('.', comparison.path.find('.') + 1);
  Predicate field{.poster = comparison.path.substr(0, poster_end),
                  .path = comparison.path.substr(poster_end + 1),
                  .place = comparison.place};
  const auto of = [&](Predicate::Kind kind) {
    field.kind = kind;
    field.number = kind == Predicate::Kind::present ? 0 : comparison.number;
    return predicate(field);
  };
  const auto below = [&](Predicate::Kind kind) {
    const Node present = of(Predicate::Kind::present);
    return diagrams_.conjunction(present, diagrams_.negation(of(kind)));
  };
  switch (comparison.relation) {
    case Relation::less: return below(Predicate::Kind::greater_equal);
    case Relation::less_equal: return below(Predicate::Kind::greater);
    case Relation::greater_equal: return of(Predicate::Kind::greater_equal);
    case Relation::greater: return of(Predicate::Kind::greater);
    case Relation::equal: {
      const Node least = of(Predicate::Kind::greater_equal);
      return diagrams_.conjunction(least, diagrams_.negation(of(Predicate::Kind::greater)));
    }
    case Relation::not_equal: break;
  }
  const Node less = below(Predicate::Kind::greater_equal);
  return diagrams_.disjunction(less, of(Predicate::Kind::greater));
}

Automaton::Node Automaton::since(Node lasting, Node begin) {
  for (const Since& known : since_)
    if (known.lasting == lasting && known.begin == begin) return known.value;
  const std::size_t variable = predicates_.size();
  predicates_.push_back({.kind = Predicate::Kind::memory});
  const Node bit = diagrams_.variable(variable);
  const Node value = diagrams_.disjunction(begin, diagrams_.conjunction(lasting, bit));
  memory_.push_back({variable, value});
  since_.push_back({lasting, begin, value});
  return value;
}

}  // namespace waitpoint::control
