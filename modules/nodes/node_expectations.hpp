// SPDX-License-Identifier: BSD-3-Clause
// A scenario's expectations of its nodes: how many may fail (none, unless it says so), how long a call of a service may
// take, the numbers in messages, and that the tests of launch files pass.
#pragma once

#include <string>
#include <vector>

#include "modules/nodes/node_processes.hpp"
#include "modules/nodes/node_side.hpp"
#include "modules/outside/partner.hpp"
#include "modules/scenario/scenario.hpp"

namespace waitpoint::nodes {

class NodeExpectations {
 public:
  /// `expect` must outlive this.
  explicit NodeExpectations(const scenario::Expectation& expect);

  /// At each step: which calls of services take too long, and which messages are not as expected.
  void watch(outside::Host& host, NodeSide& nodes);
  /// A node has failed, in words.
  void note_failure(std::string failure) { failures_.push_back(std::move(failure)); }

  /// True if one cannot be met any more.
  bool is_lost(outside::Host& host, const NodeProcesses& processes) const;
  /// At the end, a line for each that is not met.
  std::vector<std::string> unmet(const NodeProcesses& processes, const NodeSide& nodes) const;

 private:
  bool are_too_many(std::size_t failures) const { return failures > expect_.node_failures.value_or(0); }
  void watch_calls(outside::Host& host);

  const scenario::Expectation& expect_;
  std::vector<std::string> failures_, long_calls_, breaches_;
};

}  // namespace waitpoint::nodes
