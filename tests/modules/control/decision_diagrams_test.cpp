// SPDX-License-Identifier: BSD-3-Clause
// Decision diagrams: equal functions are one node, and the questions about a function agree with its truth table.
#include <gtest/gtest.h>

#include "core/random.hpp"
#include "modules/control/decision_diagrams.hpp"

namespace waitpoint::control {
namespace {

using Node = DecisionDiagrams::Node;

constexpr std::size_t variables = 5, rows = 1 << variables;

std::vector<bool> row_values(std::size_t row) {
  std::vector<bool> values;
  for (std::size_t v = 0; v < variables; ++v) values.push_back((row >> v & 1) != 0);
  return values;
}

/// A random function as a diagram and as a truth table, a bit for each row.
struct Function {
  Node node;
  std::uint32_t table;
};

Function random_function(DecisionDiagrams& diagrams, const RandomStream& random, std::uint64_t& draws, int depth) {
  const auto draw = [&](std::uint64_t below) {
    return static_cast<std::uint64_t>(random.uniform(draws++) * static_cast<double>(below));
  };
  if (depth == 0) {
    const std::size_t v = draw(variables);
    std::uint32_t table = 0;
    for (std::size_t row = 0; row < rows; ++row) table |= static_cast<std::uint32_t>(row >> v & 1) << row;
    return {diagrams.variable(v), table};
  }
  const Function a = random_function(diagrams, random, draws, depth - 1);
  const Function b = random_function(diagrams, random, draws, depth - 1);
  const Function c = random_function(diagrams, random, draws, depth - 1);
  switch (draw(4)) {
    case 0: return {diagrams.conjunction(a.node, b.node), a.table & b.table};
    case 1: return {diagrams.disjunction(a.node, b.node), a.table | b.table};
    case 2: return {diagrams.negation(a.node), ~a.table};
    default: return {diagrams.choice(a.node, b.node, c.node), (a.table & b.table) | (~a.table & c.table)};
  }
}

TEST(DecisionDiagrams, AgreeWithTheTruthTablesOfRandomFunctions) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const RandomStream random(seed, "test", "functions");
    std::uint64_t draws = 0;
    DecisionDiagrams diagrams;
    const Function f = random_function(diagrams, random, draws, 4), g = random_function(diagrams, random, draws, 4);
    EXPECT_EQ(f.node == g.node, f.table == g.table) << "seed " << seed;
    std::vector<DecisionDiagrams::Domain> domains;
    for (std::size_t v = 0; v < variables; ++v) {
      const double kind = random.uniform(draws++);
      domains.push_back({kind < 0.7, kind >= 0.3});
    }
    const DecisionDiagrams::Fixed fixed{{1, true}, {3, false}};
    const Node restricted = diagrams.restricted(f.node, fixed);
    bool is_possible = false;
    std::vector<bool> depends(variables);
    for (std::size_t row = 0; row < rows; ++row) {
      const std::vector<bool> values = row_values(row);
      const bool truth = (f.table >> row & 1) != 0;
      EXPECT_EQ(diagrams.evaluate(f.node, values), truth) << "seed " << seed;
      EXPECT_EQ(diagrams.evaluate(restricted, values), (f.table >> ((row | 2U) & ~8U) & 1) != 0) << "seed " << seed;
      bool is_allowed = truth;
      for (std::size_t v = 0; v < variables; ++v) {
        is_allowed = is_allowed && (values[v] ? domains[v].may_be_true : domains[v].may_be_false);
        if (truth != ((f.table >> (row ^ (std::size_t{1} << v)) & 1) != 0)) depends[v] = true;
      }
      is_possible = is_possible || is_allowed;
    }
    EXPECT_EQ(diagrams.is_possible(f.node, domains), is_possible) << "seed " << seed;
    for (std::size_t v = 0; v < variables; ++v)
      EXPECT_EQ(diagrams.depends_on(f.node, v), depends[v]) << "seed " << seed;
  }
}

}  // namespace
}  // namespace waitpoint::control
