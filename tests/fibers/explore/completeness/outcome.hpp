// SPDX-License-Identifier: BSD-3-Clause
// The outcome of a run, as text:
//
//   ended: 0[1 0] 1[] memory 2 0        all threads ended; what each read, and the atomics
//   stuck {0 1}: 0[1 0] ...             the same, but these threads are blocked for ever
//   cycle {0 1}: 0[1] 1[]               these threads wait for each other
//   exit 1: 1[0]                        thread 1 ended the program
//   misuse 0: 0[1]                      thread 0 misused a primitive, or ended while it held a mutex
//
// Of a run that is ended only what the threads named had read belongs to the outcome: the others may be anywhere.
#pragma once

#include <set>
#include <string>
#include <vector>

namespace waitpoint::completeness {

using Outcomes = std::set<std::string>;

/// What the threads of a finished run have read, and where it left the atomics.
struct Observed {
  std::vector<std::vector<int>> reads;  ///< by thread
  std::vector<int> values;
};

/// `end` is one of the words above; `threads` are those that it names, in ascending order.
std::string outcome(const std::string& end, const std::vector<std::size_t>& threads, const Observed& observed);

}  // namespace waitpoint::completeness
