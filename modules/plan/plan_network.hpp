// SPDX-License-Identifier: BSD-3-Clause
// The temporal network of a plan in a situation: chosen branches, executed points, given-up bounds.
//
// Actions that may overlap and together need more than the capacity of a resource are put in an order, by a search with
// rollback: first that of the file, then others. Orders are constraints like those of the file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/plan/dispatcher.hpp"
#include "modules/plan/plan.hpp"

namespace waitpoint::plan {

/// How far a plan has come.
struct Situation {
  explicit Situation(const TemporalPlan& plan);

  std::vector<std::size_t> branch;             ///< by alternative; the number of branches: none is left
  std::vector<std::optional<Duration>> times;  ///< by point, of executed ones
  std::vector<bool> loosened;                  ///< by action: its bounds no longer hold
  Duration now;                                ///< the lower bound of future points

  bool is_active(const TemporalPlan& plan, std::size_t action) const;
};

class PlanNetwork {
 public:
  PlanNetwork(const TemporalPlan& plan, const Situation& situation);

  const Network& network() const { return network_; }
  /// The resource at which the search for an order of its actions was given up: the network then contradicts itself.
  std::optional<std::size_t> unordered() const { return unordered_; }
  /// "'the light' (line 12), 'duration of visit' (line 5)": for conflicts.
  std::string conflict_text(const std::vector<std::uint32_t>& labels) const;
  /// The place of the first of them.
  const scenario::Location& place(const std::vector<std::uint32_t>& labels) const;

 private:
  struct Label {
    std::string name;
    scenario::Location written;
  };
  std::uint32_t label(std::string name, const scenario::Location& written);
  void add_action(const TemporalPlan& plan, const Situation& situation, std::size_t action);
  void add_resources(const TemporalPlan& plan, const Situation& situation);

  Network network_;
  std::optional<std::size_t> unordered_;
  std::vector<Label> labels_;
};

/// The analysis of a plan before its execution.
struct PlanCheck {
  std::size_t points = 0, constraints = 0;
  bool controllable = true;
  std::string conflict;  ///< if not controllable
};

/// With the first branches, and each other branch in the place of the first of its alternative. Throws BadInput with a
/// negative cycle, at its first constraint, if one of these networks is not consistent.
PlanCheck check(const TemporalPlan& plan);

/// "13 time points, 30 constraints: consistent, dynamically controllable".
std::string to_string(const PlanCheck& check);

}  // namespace waitpoint::plan
