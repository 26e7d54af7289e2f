// SPDX-License-Identifier: BSD-3-Clause
// Bugs in one of very many schedules: as hard as the hardest in the literature.
#include <cstdint>

#include "fibers/explore/explore.hpp"
#include "fibers/sync/atomic.hpp"
#include "fibers/sync/mutex.hpp"
#include "tests/zoo/zoo.hpp"

// Need the primitives declared above.
#include "tests/zoo/shared/element_stack.hpp"
#include "tests/zoo/shared/hard.hpp"
#include "tests/zoo/shared/stealing.hpp"

namespace waitpoint::zoo {

Specimens hard() {
  return {{"two-stage of 100", two_stage_of_all<false, 99>, two_stage_of_all<true, 99>, 1, "atomicity"},
          {"reorder of 100", reorder_of_all<false, 100>, reorder_of_all<true, 100>, 1, "order"},
          {"stack of elements", element_stack<false>, element_stack<true>, 5, "lock-free", true},
          {"THE queue", steal_from<TheQueue<false>>, steal_from<TheQueue<true>>, 2, "lock-free"},
          {"state-word queue", steal_from<StateQueue<false>>, steal_from<StateQueue<true>>, 1, "lock-free"},
          {"growth of 5", growth<false, 2, 5, 144>, growth<true, 2, 5, 144>, 8, "atomicity", true},
          {"growth of 8", growth<false, 2, 8, 2584>, growth<true, 2, 8, 2584>, 14, "atomicity", true},
          {"growth of 5 among 3", growth<false, 3, 5, 536>, growth<true, 3, 5, 536>, 12, "atomicity", true},
          {"growth of 5 among 4", growth<false, 4, 5, 2842>, growth<true, 4, 5, 2842>, 16, "atomicity", true}};
}

}  // namespace waitpoint::zoo
