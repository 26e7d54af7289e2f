// SPDX-License-Identifier: BSD-3-Clause
#include "modules/control/decision_diagrams.hpp"

#include <algorithm>
#include <limits>

namespace waitpoint::control {
namespace {

constexpr std::uint32_t of_leaf = std::numeric_limits<std::uint32_t>::max();  // after all variables

}  // namespace

DecisionDiagrams::DecisionDiagrams() : nodes_{{of_leaf, no, no}, {of_leaf, yes, yes}} {}

DecisionDiagrams::Node DecisionDiagrams::node(std::uint32_t variable, Node positive, Node negative) {
  if (positive == negative) return positive;
  const auto [entry, is_new] = unique_.try_emplace({variable, positive, negative}, static_cast<Node>(nodes_.size()));
  if (is_new) nodes_.push_back({variable, positive, negative});
  return entry->second;
}

DecisionDiagrams::Node DecisionDiagrams::restricted(Node node, const Fixed& values) {
  std::vector<Node> results(static_cast<std::size_t>(node) + 2);
  results[yes] = yes;
  for (const Node each : below(node)) {
    const Branch branch = nodes_[each];
    const Node positive = results[branch.positive], negative = results[branch.negative];
    const auto fixed = values.find(branch.variable);
    results[each] = fixed == values.end() ? choice(variable(branch.variable), positive, negative)
                    : fixed->second       ? positive
                                          : negative;
  }
  return results[node];
}

DecisionDiagrams::Node DecisionDiagrams::cofactor(Node node, std::uint32_t variable, bool value) const {
  const Branch& branch = nodes_[node];
  if (branch.variable != variable) return node;
  return value ? branch.positive : branch.negative;
}

DecisionDiagrams::Node DecisionDiagrams::choice(Node condition, Node positive, Node negative) {
  if (condition == yes) return positive;
  if (condition == no || positive == negative) return negative;
  if (positive == yes && negative == no) return condition;
  if (is_full()) return no;
  const std::tuple key(condition, positive, negative);
  if (const auto known = choices_.find(key); known != choices_.end()) return known->second;
  const std::uint32_t top =
      std::min({nodes_[condition].variable, nodes_[positive].variable, nodes_[negative].variable});
  const auto branch = [&](bool value) {
    return choice(cofactor(condition, top, value), cofactor(positive, top, value), cofactor(negative, top, value));
  };
  const Node if_true = branch(true), if_false = branch(false);
  const Node result = node(top, if_true, if_false);
  choices_.emplace(key, result);
  return result;
}

bool DecisionDiagrams::evaluate(Node node, const std::vector<bool>& values) const {
  while (node > yes) node = values[nodes_[node].variable] ? nodes_[node].positive : nodes_[node].negative;
  return node == yes;
}

// A node's children have lower numbers.
std::vector<DecisionDiagrams::Node> DecisionDiagrams::below(Node node) const {
  std::vector<bool> is_below(static_cast<std::size_t>(node) + 2);
  is_below[node] = true;
  std::vector<Node> nodes;
  for (Node each = node; each > yes; --each) {
    if (!is_below[each]) continue;
    nodes.push_back(each);
    is_below[nodes_[each].positive] = is_below[nodes_[each].negative] = true;
  }
  std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

bool DecisionDiagrams::is_possible(Node node, const std::vector<Domain>& domains) const {
  std::vector<bool> possible(static_cast<std::size_t>(node) + 2);
  possible[yes] = true;
  for (const Node each : below(node)) {
    const Branch& branch = nodes_[each];
    const Domain& domain = domains[branch.variable];
    possible[each] =
        (domain.may_be_true && possible[branch.positive]) || (domain.may_be_false && possible[branch.negative]);
  }
  return possible[node];
}

bool DecisionDiagrams::depends_on(Node node, std::size_t variable) const {
  const std::vector<Node> nodes = below(node);
  return std::any_of(nodes.begin(), nodes.end(), [&](Node each) { return nodes_[each].variable == variable; });
}

}  // namespace waitpoint::control
