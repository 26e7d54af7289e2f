// SPDX-License-Identifier: BSD-3-Clause
// Compiled rules: a finite automaton over predicates. Its state is a bit of memory for each temporal operator; a
// check's condition and a bit's next value are decision diagrams over predicates and memory, so that a step takes a
// bounded time.
//
//   since(e, f) = f || (e && bit), which is the bit's next value      past(e)   = since(true, e)
//   never(e)    = !past(e)                                            always(e) = !past(!e)
#pragma once

#include <string>
#include <vector>

#include "modules/control/decision_diagrams.hpp"
#include "modules/control/predicate.hpp"
#include "modules/control/rules.hpp"

namespace waitpoint::control {

class Automaton {
 public:
  using Node = DecisionDiagrams::Node;

  /// Compiles all checks. BadInput for rules that need too many nodes.
  explicit Automaton(const Rules& rules);

  /// The variables, in the order of the diagrams.
  const std::vector<Predicate>& predicates() const { return predicates_; }
  /// Of predicates and of the checks' actions, without repetitions.
  const std::vector<RequestPattern>& patterns() const { return patterns_; }
  /// True if each request that meets pattern `p` meets `q`, too.
  bool implies(std::size_t p, std::size_t q) const { return implied_[p][q]; }
  /// True if the predicate holds because of a request that meets pattern `p`.
  bool is_of(const Predicate& predicate, std::size_t p) const {
    return predicate.is_of_request() && implies(p, predicate.pattern);
  }
  /// The index of a pattern of the rules.
  std::size_t index_of(const RequestPattern& pattern) const;
  std::size_t checks() const { return forbidden_.size(); }

  /// The values of all predicates before the first step: false, except that memory is as at the start.
  std::vector<bool> initial_values() const { return std::vector<bool>(predicates_.size()); }
  /// True if check `i` forbids the state.
  bool is_forbidden(std::size_t i, const std::vector<bool>& values) const {
    return diagrams_.evaluate(forbidden_[i], values);
  }
  /// True if a request that meets pattern `p` can bring about the state that check `i` forbids.
  bool raises(std::size_t i, std::size_t p) const { return raises_[i][p]; }
  /// Ends a step: sets the memory in `values` for the next one.
  void remember(std::vector<bool>& values) const;

  // For the search of contradictions.
  DecisionDiagrams& diagrams() { return diagrams_; }
  const DecisionDiagrams& diagrams() const { return diagrams_; }
  Node forbidden(std::size_t check) const { return forbidden_[check]; }

  struct Memory {
    std::size_t variable;
    Node next;
  };
  const std::vector<Memory>& memory() const { return memory_; }

 private:
  /// BadInput for `check`, at which the rules have come to need too many nodes.
  void expect_room(const Rules& rules, const Check& check) const;
  void find_raising(std::size_t check);
  Node compile(const Expression& expression);
  Node compile(const Comparison& comparison);
  Node since(Node lasting, Node begin);
  Node of_request(Predicate::Kind kind, const Expression& expression);
  Node predicate(const Predicate& predicate);
  std::size_t pattern(const RequestPattern& pattern);
  std::vector<RequestPattern>::const_iterator find(const RequestPattern& pattern) const;

  DecisionDiagrams diagrams_;
  std::vector<Predicate> predicates_;
  std::vector<RequestPattern> patterns_;
  std::vector<std::vector<bool>> implied_;  // by pattern and pattern
  std::vector<Node> forbidden_;
  std::vector<std::vector<bool>> raises_;  // by check and pattern
  std::vector<Memory> memory_;
  struct Since {
    Node lasting, begin, value;
  };
  std::vector<Since> since_;  // equal operators share a bit
};

}  // namespace waitpoint::control
