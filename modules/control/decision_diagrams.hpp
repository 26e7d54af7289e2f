// SPDX-License-Identifier: BSD-3-Clause
// Ordered binary decision diagrams: Boolean functions of numbered variables as directed graphs, in which equal
// functions are one node (Bryant, "Graph-based algorithms for Boolean function manipulation", IEEE ToC 1986).
//
//   variable 0:        a         a && b:  a --then--> b --then--> yes
//   variable 1:        b                  |           |
//                                         +-- else ---+---------> no
//
// The variables' order is that of their numbers. An evaluation takes at most one step for each variable.
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace waitpoint::control {

class DecisionDiagrams {
 public:
  using Node = std::uint32_t;
  static constexpr Node no = 0, yes = 1;
  /// Beyond this, is_full() is true, and results are meaningless.
  static constexpr std::size_t nodes_max = 1 << 17;

  DecisionDiagrams();

  Node variable(std::size_t number) { return node(static_cast<std::uint32_t>(number), yes, no); }
  /// `condition ? positive : negative`, from which all operators follow.
  Node choice(Node condition, Node positive, Node negative);
  Node conjunction(Node a, Node b) { return choice(a, b, no); }
  Node disjunction(Node a, Node b) { return choice(a, yes, b); }
  Node negation(Node a) { return choice(a, no, yes); }
  Node implication(Node a, Node b) { return choice(a, b, yes); }

  bool is_full() const { return nodes_.size() > nodes_max; }
  std::size_t size() const { return nodes_.size(); }

  bool evaluate(Node node, const std::vector<bool>& values) const;
  bool depends_on(Node node, std::size_t variable) const;
  /// The function with `values` of some variables fixed.
  using Fixed = std::map<std::uint32_t, bool>;
  Node restricted(Node node, const Fixed& values);

  /// The values that a variable may have.
  struct Domain {
    bool may_be_false = true, may_be_true = true;
  };
  /// True if the function is true for some values in the variables' domains.
  bool is_possible(Node node, const std::vector<Domain>& domains) const;

 private:
  struct Branch {
    std::uint32_t variable;
    Node positive, negative;
  };
  using Key = std::tuple<std::uint32_t, Node, Node>;

  Node node(std::uint32_t variable, Node positive, Node negative);
  /// The nodes that `node` leads to and itself, without leaves, children first.
  std::vector<Node> below(Node node) const;
  Node cofactor(Node node, std::uint32_t variable, bool value) const;

  std::vector<Branch> nodes_;
  std::map<Key, Node> unique_;
  std::map<std::tuple<Node, Node, Node>, Node> choices_;  // results so far
};

}  // namespace waitpoint::control
