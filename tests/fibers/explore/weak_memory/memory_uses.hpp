// SPDX-License-Identifier: BSD-3-Clause
// Uses of atomics at the bounds of weak memory: loops, many stores, plain accesses, memory used again. Each is a body
// for explore(), compiled with -fsanitize=thread.
#pragma once

namespace waitpoint::weak_memory {

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
