// SPDX-License-Identifier: BSD-3-Clause
// What becomes of mutexes that a thread holds when it ends, or when its process is forked. The next owner of a robust
// one is told that the one before ended without unlocking.
#pragma once

namespace waitpoint::posix {

/// Passes on the robust mutexes that the running thread holds at its end. Others stay locked.
void let_robust_mutexes_go();
/// In a child: those that processes share are held by the parent's thread still, not by its copy.
void leave_shared_mutexes();

}  // namespace waitpoint::posix
