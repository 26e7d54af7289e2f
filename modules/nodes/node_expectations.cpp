// SPDX-License-Identifier: BSD-3-Clause
#include "modules/nodes/node_expectations.hpp"

#include <optional>
#include <utility>

#include "modules/nodes/node_waits.hpp"
#include "modules/run/expectation.hpp"

namespace waitpoint::nodes {

NodeExpectations::NodeExpectations(const scenario::Expectation& expect) : expect_(expect) {
  if (expect.service_call_max_s) watch_waits();
}

void NodeExpectations::watch(outside::Host& host, NodeSide& nodes) {
  watch_calls(host);
  for (std::string& breach : nodes.take_breaches()) breaches_.push_back(std::move(breach));
}

// Told with all that waits: a call that does not return may wait for a lock.
void NodeExpectations::watch_calls(outside::Host& host) {
  if (!expect_.service_call_max_s || !long_calls_.empty()) return;
  const Duration most = Duration::from_seconds(*expect_.service_call_max_s);
  if (calls_longer_than(most).empty()) return;
  const Duration long_time = Duration::from_ns(most.ns() / 2);
  long_calls_ = calls_longer_than(long_time);
  for (const std::string& wait : waits_longer_than(long_time)) host.tell("nodes", wait);
}

bool NodeExpectations::is_lost(outside::Host& host, const NodeProcesses& processes) const {
  return are_too_many(failures_.size()) || !long_calls_.empty() || !breaches_.empty() ||
         !processes.unmet_tests(host.next_step()).empty() || !run::broken(expect_, host.experiment().figures()).empty();
}

std::vector<std::string> NodeExpectations::unmet(const NodeProcesses& processes, const NodeSide& nodes) const {
  std::vector<std::string> lines = long_calls_;
  lines.insert(lines.end(), breaches_.begin(), breaches_.end());
  for (const std::string& topic : nodes.unheard_topics()) lines.push_back("topic " + topic + " had no message");
  std::vector<std::string> failures = failures_;
  for (std::string& line : processes.not_started()) failures.push_back(std::move(line));
  if (are_too_many(failures.size())) lines.insert(lines.end(), failures.begin(), failures.end());
  for (std::string& line : processes.unmet_tests(std::nullopt)) lines.push_back(std::move(line));
  if (expect_.tests_passed && !processes.have_tests()) lines.emplace_back("there is no test in the launch files");
  return lines;
}

}  // namespace waitpoint::nodes
