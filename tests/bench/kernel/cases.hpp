// SPDX-License-Identifier: BSD-3-Clause
// What the kernel is measured on, and how fast it has to be: against a peer in the same run, or in itself.
#pragma once

#include <string>
#include <vector>

namespace waitpoint::bench {

/// One who carries workloads out, each a program of its own, build/tests/bench/kernel-PROGRAM.
struct Subject {
  std::string program;
  std::string name;   ///< in tables: of a peer, the package that it comes from
  bool peer = true;   ///< else it is us, or the limit, which need nothing that is not needed anyway
  int tasks_max = 0;  ///< more it cannot; 0 is without limit
};
const std::vector<Subject>& subjects();

/// A bound on one figure. `against` a subject's name: the ratio of its figure to ours, at least `bound`; against the
/// limit: of ours to it, at most. Empty: the figure itself, at most.
struct Bound {
  std::string answer;  ///< "ns", or what else a measuring process answers
  std::string against;
  double bound;
};

struct Case {
  std::string workload;
  int tasks;
  std::string title;
  std::string unit;  ///< what a nanosecond figure is counted by
  std::vector<Bound> musts, aims;

  /// Whether it is measured with a watch on the kernel, too.
  bool has_hooks() const { return workload != "parked" && tasks <= 100'000; }
};
const std::vector<Case>& cases();

}  // namespace waitpoint::bench
