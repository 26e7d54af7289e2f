// SPDX-License-Identifier: BSD-3-Clause
#include "tests/zoo/zoo.hpp"

namespace waitpoint::zoo {

const Specimens& specimens() {
  static const Specimens all = [] {
    Specimens found;
    for (Specimens (*kind)() : {deadlocks, atomicities, lock_free, orders, signals, endings, robots, timings, hard})
      for (const Specimen& specimen : kind()) found.push_back(specimen);
    return found;
  }();
  return all;
}

}  // namespace waitpoint::zoo
