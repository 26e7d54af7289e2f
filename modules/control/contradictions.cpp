// SPDX-License-Identifier: BSD-3-Clause
#include "modules/control/contradictions.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <string>
#include <vector>

namespace waitpoint::control {
namespace {

using Node = DecisionDiagrams::Node;
using Domain = DecisionDiagrams::Domain;
using Kind = Predicate::Kind;
using Checks = std::vector<std::size_t>;

constexpr Domain false_only{true, false}, true_only{false, true};

bool is_same_field(const Predicate& a, const Predicate& b) { return a.poster == b.poster && a.path == b.path; }

/// True if `a` cannot hold without `b`, whatever the rules.
bool implies(const Predicate& a, const Predicate& b, const Automaton& automaton) {
  const auto is_threshold = [](Kind kind) { return kind == Kind::greater || kind == Kind::greater_equal; };
  if (a.is_of_request() && b.is_of_request()) {
    const bool is_of_kind = a.kind == b.kind
                                ? a.time >= b.time
                                : b.kind == Kind::running && (a.kind == Kind::requested || a.kind == Kind::lasting);
    return is_of_kind && automaton.implies(a.pattern, b.pattern);
  }
  if (is_threshold(a.kind) && is_threshold(b.kind) && is_same_field(a, b))
    return a.number > b.number || (a.number == b.number && a.kind == Kind::greater);
  if (is_threshold(a.kind) && b.kind == Kind::present) return is_same_field(a, b);
  if ((is_threshold(a.kind) || a.kind == Kind::present) && b.kind == Kind::given) return a.poster == b.poster;
  if (a.kind == Kind::aged && b.kind == Kind::aged) return a.poster == b.poster && a.time >= b.time;
  return false;
}

/// The conditions of all checks together need more nodes than there are.
struct TooLarge {};

class Search {
 public:
  Search(const Rules& rules, Automaton& automaton)
      : rules_(rules), automaton_(automaton), diagrams_(automaton.diagrams()), all_(rules.checks.size()) {
    std::iota(all_.begin(), all_.end(), std::size_t{0});
    make_theory();
  }

  void run() {
    check_patterns();
    for (const std::size_t i : all_) check_alone(i);
    check_start();
    const Reachable reachable = reach(all_);
    for (std::size_t p = 0; p < automaton_.patterns().size(); ++p)
      if (!is_accepted(p, reachable)) refuse_never_accepted(p);
    const std::vector<Domain> without_checks = reach({}).domains;
    for (const std::size_t i : all_)
      if (!diagrams_.is_possible(diagrams_.conjunction(theory_, automaton_.forbidden(i)), without_checks))
        refuse(i, "the condition can never hold");
    check_size();
  }

 private:
  struct Reachable {
    std::vector<Domain> domains;
    std::vector<bool> accepted;  // by pattern
  };

  const std::vector<Predicate>& predicates() const { return automaton_.predicates(); }
  const std::string& name(std::size_t check) const { return rules_.checks[check].name; }
  [[noreturn]] void refuse(std::size_t check, const std::string& message) const {
    check_size();
    throw bad(rules_.file, rules_.checks[check].place, "check " + name(check) + ": " + message);
  }

  /// Results are meaningless from then on: nothing is reported.
  void check_size() const {
    if (diagrams_.is_full()) throw TooLarge();
  }

  /// Invariants of every state, independent of the rules. An implication that follows from two others is left out.
  void make_theory() {
    const std::size_t count = predicates().size();
    std::vector<std::vector<bool>> implied(count, std::vector<bool>(count));
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < count; ++b) implied[a][b] = implies(predicates()[a], predicates()[b], automaton_);
    const auto follows = [&](std::size_t a, std::size_t b) {
      for (std::size_t c = 0; c < count; ++c)
        if (implied[a][c] && implied[c][b] && !implied[c][a] && !implied[b][c]) return true;
      return false;
    };
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = 0; b < count; ++b)
        if (a != b && implied[a][b] && !follows(a, b)) add(a, b, false);
      // A poster that was never given is of any age.
      for (std::size_t b = 0; b < count && predicates()[a].kind == Kind::aged; ++b)
        if (predicates()[b].kind == Kind::given && predicates()[a].poster == predicates()[b].poster) add(b, a, true);
    }
  }
  void add(std::size_t a, std::size_t b, bool is_negated) {
    const Node condition = diagrams_.variable(a);
    const Node implied = diagrams_.variable(b);
    theory_ = diagrams_.conjunction(
        theory_, diagrams_.implication(is_negated ? diagrams_.negation(condition) : condition, implied));
  }

  void check_patterns() const {
    for (const RequestPattern& pattern : automaton_.patterns())
      if (is_empty(pattern))
        throw bad(rules_.file, pattern.place, "no input of " + request_name(pattern) + " meets these comparisons");
  }

  void check_alone(std::size_t i) {
    const Node forbidden = automaton_.forbidden(i);
    const Check& check = rules_.checks[i];
    if (diagrams_.conjunction(theory_, forbidden) == DecisionDiagrams::no) refuse(i, "the condition can never hold");
    if (diagrams_.implication(theory_, forbidden) == DecisionDiagrams::yes)
      refuse(i, "the condition always holds: no request could be accepted");
    const auto can_act = [&](const Predicate& predicate) {
      return predicate.kind == Kind::requested || predicate.kind == Kind::running || predicate.kind == Kind::lasting;
    };
    const auto depends = [&](const auto& of) {
      for (std::size_t v = 0; v < predicates().size(); ++v)
        if (of(predicates()[v]) && diagrams_.depends_on(forbidden, v)) return true;
      return false;
    };
    if (check.interrupted.empty() && !depends(can_act))
      refuse(i,
             "expected request(), running() or duration() in the condition, or activities to interrupt: the "
             "controller cannot prevent this state");
    for (const RequestPattern& delayed : check.delayed) {
      const auto is_of_delayed = [&](const Predicate& predicate) {
        return can_act(predicate) && is_same_request(automaton_.patterns()[predicate.pattern], delayed);
      };
      if (!depends(is_of_delayed))
        throw bad(
            rules_.file, delayed.place,
            "check " + name(i) + " never delays " + request_name(delayed) + ": its condition does not depend on it");
    }
  }

  /// The states that none of `checks` forbids.
  Node safe(const Checks& checks) {
    Node safe = theory_;
    for (const std::size_t i : checks) safe = diagrams_.conjunction(safe, diagrams_.negation(automaton_.forbidden(i)));
    return safe;
  }

  std::vector<Domain> start() const {
    std::vector<Domain> domains;
    for (const Predicate& predicate : predicates())
      domains.push_back(predicate.is_of_request() || predicate.kind == Kind::memory ? false_only : Domain{});
    return domains;
  }

  void check_start() {
    const auto is_kept = [this](const Checks& checks) { return diagrams_.is_possible(safe(checks), start()); };
    if (is_kept(all_)) return;
    const Checks least = least_contradicting(is_kept);
    if (least.size() == 1)
      refuse(least.front(), "the condition holds while nothing runs: no request could be accepted");
    refuse(least.back(), "demands the opposite of " + others(least) + ": one of them fails even while nothing runs");
  }

  /// Requests accepted in some state from the start on, and the values of predicates in all of these states.
  Reachable reach(const Checks& checks) {
    const Node safe_states = safe(checks);
    Reachable reachable{start(), std::vector<bool>(automaton_.patterns().size())};
    for (bool grows = true; grows;) {
      grows = false;
      for (std::size_t p = 0; p < reachable.accepted.size(); ++p) {
        if (reachable.accepted[p] || !diagrams_.is_possible(safe_states, after(p, reachable.domains))) continue;
        reachable.accepted[p] = grows = true;
        for (std::size_t v = 0; v < predicates().size(); ++v)
          if (automaton_.is_of(predicates()[v], p)) reachable.domains[v].may_be_true = true;
      }
      for (const Automaton::Memory& bit : automaton_.memory()) {
        bool& may_be_true = reachable.domains[bit.variable].may_be_true;
        if (may_be_true || !diagrams_.is_possible(diagrams_.conjunction(theory_, bit.next), reachable.domains))
          continue;
        may_be_true = grows = true;
      }
    }
    return reachable;
  }

  /// The domains in the step that accepts a request of pattern `p`.
  std::vector<Domain> after(std::size_t p, std::vector<Domain> domains) const {
    for (std::size_t v = 0; v < predicates().size(); ++v) {
      const Predicate& predicate = predicates()[v];
      if (predicate.kind == Kind::succeeded || predicate.kind == Kind::failed) domains[v] = false_only;
      const bool is_now = predicate.kind == Kind::requested || predicate.kind == Kind::running;
      if (is_now && automaton_.is_of(predicate, p))
        domains[v] = true_only;
      else if (predicate.kind == Kind::requested &&
               !is_same_request(automaton_.patterns()[predicate.pattern], automaton_.patterns()[p]))
        domains[v] = false_only;
    }
    return domains;
  }

  /// A request type is accepted if it is with some input.
  bool is_accepted(std::size_t p, const Reachable& reachable) const {
    const std::vector<RequestPattern>& patterns = automaton_.patterns();
    if (!patterns[p].inputs.empty()) return true;  // such patterns forbid unwanted states
    for (std::size_t q = 0; q < patterns.size(); ++q)
      if (reachable.accepted[q] && is_same_request(patterns[p], patterns[q])) return true;
    return false;
  }

  [[noreturn]] void refuse_never_accepted(std::size_t p) {
    const std::string request = request_name(automaton_.patterns()[p]);
    const Checks least = least_contradicting([this, p](const Checks& checks) { return is_accepted(p, reach(checks)); });
    if (least.size() == 1) refuse(least.front(), "no " + request + " can ever be accepted");
    refuse(least.back(),
           "demands the opposite of " + others(least) + ": with both, no " + request + " can ever be accepted");
  }

  /// A smallest set of checks, by leaving out one after another, that are still not `kept` together.
  Checks least_contradicting(const std::function<bool(const Checks&)>& is_kept) const {
    Checks checks = all_;
    for (std::size_t i = 0; i < checks.size();) {
      Checks fewer = checks;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      if (is_kept(fewer))
        ++i;
      else
        checks = std::move(fewer);
    }
    return checks;
  }
  std::string others(const Checks& checks) const {
    std::string names;
    for (std::size_t i = 0; i + 1 < checks.size(); ++i) names += (i > 0 ? " and " : "") + name(checks[i]);
    return names;
  }

  const Rules& rules_;
  Automaton& automaton_;
  DecisionDiagrams& diagrams_;
  Checks all_;
  Node theory_ = DecisionDiagrams::yes;
};

}  // namespace

void check_contradictions(const Rules& rules, Automaton automaton) {
  try {
    Search(rules, automaton).run();
  } catch (const TooLarge&) {
    return;
  }
}

}  // namespace waitpoint::control
