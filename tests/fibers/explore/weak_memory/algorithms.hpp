// SPDX-License-Identifier: BSD-3-Clause
// Classic algorithms on the standard's atomics, with the memory orders that decide whether they are right. Each is a
// body for explore(), compiled with -fsanitize=thread, and fails by check().
#pragma once

#include <atomic>

namespace waitpoint::weak_memory {

using Order = std::memory_order;

/// Mutual exclusion by two flags and a turn.
void peterson(Order stores, Order loads);
/// The same with relaxed operations and fences.
void dekker(Order fence);
/// A lock by exchange(acquire); its release is a store.
void spinlock(Order unlock);
/// A counter before and after the stores of a writer, which a reader compares (Boehm, MSPC 2012).
void sequence_lock(Order writers_fence, Order readers_fence);
/// A work-stealing deque (Chase, Lev 2005) with the orders of Le, Pop, Cohen, Zappa Nardelli, "Correct and efficient
/// work-stealing for weak memory models", PPoPP 2013.
void work_stealing_deque(Order fence_of_take);
/// A singleton made under a lock, and looked for without it.
void double_checked_lock(Order publication, Order look);

}  // namespace waitpoint::weak_memory
