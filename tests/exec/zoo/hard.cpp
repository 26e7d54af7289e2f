// SPDX-License-Identifier: BSD-3-Clause
// Bugs in one of very many schedules: as hard as the hardest in the literature.
#include <atomic>
#include <mutex>

#include "tests/exec/zoo/crew.hpp"

// Need the primitives declared above.
#include "tests/zoo/shared/element_stack.hpp"
#include "tests/zoo/shared/hard.hpp"
#include "tests/zoo/shared/stealing.hpp"

using namespace waitpoint::zoo;

const specimen hard[] = {
    {"two-stage of 100", RARE, 100, either<two_stage_of_all<false, 99>, two_stage_of_all<true, 99>>},
    {"reorder of 100", MEMORY, 101, either<reorder_of_all<false, 100>, reorder_of_all<true, 100>>},
    {"stack of elements", RARE, 3, either<element_stack<false>, element_stack<true>>},
    {"THE queue", MEMORY, 3, either<steal_from<TheQueue<false>>, steal_from<TheQueue<true>>>},
    {"state-word queue", MEMORY, 3, either<steal_from<StateQueue<false>>, steal_from<StateQueue<true>>>},
    {"growth of 5", RARE, 2, either<growth<false, 2, 5, 144>, growth<true, 2, 5, 144>>},
    {"growth of 8", RARE, 2, either<growth<false, 2, 8, 2584>, growth<true, 2, 8, 2584>>},
    {"growth of 5 among 3", RARE, 3, either<growth<false, 3, 5, 536>, growth<true, 3, 5, 536>>},
    {"growth of 5 among 4", RARE, 4, either<growth<false, 4, 5, 2842>, growth<true, 4, 5, 2842>>},
    {},
};
