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
/// A lock that futures spin on, with several locations in one word.
void sequence_lock(Order writers_fence, Order readers_fence);
/// A work-stealing deque (Chase, Lev 2005) with the orders of Le, Pop, Cohen, Zappa Nardelli, "Correct and efficient
/// work-stealing for weak memory models", PPoPP 2013.
void work_stealing_deque(Order fence_of_take);
/// A singleton made under a lock, and looked for without it.
void double_checked_lock(Order publication, Order look);

/// A loop that waits for a relaxed store.
void wait_for_a_flag();
/// An atomic is constructed, used, destroyed and constructed again in the same place, each time handed over in order.
void reuse_memory();
/// An atomic is modified by plain code between atomic accesses, in order.
void modify_plainly();
/// Two atomics of 4 bytes, and both as one of 8.
void access_in_two_sizes();
/// A thread makes more stores than are kept, and another one reads.
void store_often();
/// A static local that several threads construct.
void construct_a_static();
/// Store buffering: check() fails if both loads miss the other thread's store.
void buffer_stores();

}  // namespace waitpoint::weak_memory
