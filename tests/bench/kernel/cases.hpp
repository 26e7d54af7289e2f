// SPDX-License-Identifier: BSD-3-Clause
// The kernel's workloads, and its required speed: relative to a peer in the same run, or absolute.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::bench {

/// An implementation of the workloads, a program of its own, build/tests/bench/kernel-PROGRAM.
struct Subject {
  std::string program;
  std::string name;   ///< in tables; of a peer, the package's name
  bool peer = true;   ///< otherwise waitpoint or the limit, which are always available
  int tasks_max = 0;  ///< its limit of tasks; 0: none
};
const std::vector<Subject>& subjects();

/// A bound on one figure. With `against` a subject's name: the ratio of its figure to waitpoint's, at least `bound`;
/// against the limit: of waitpoint's to it, at most. Empty: the figure itself, at most.
struct Bound {
  std::string answer;  ///< "ns", or another answer of a measuring process
  std::string against;
  double bound;
};

struct Case {
  std::string workload;
  int tasks;
  std::string title;
  std::string unit;  ///< the unit of a nanosecond figure
  std::vector<Bound> musts, aims;

  /// True if it is also measured with a watch on the kernel.
  bool has_hooks() const { return workload != "parked" && tasks <= 100'000; }
};
const std::vector<Case>& cases();

}  // namespace waitpoint::bench
