// SPDX-License-Identifier: BSD-3-Clause
// Robust mutexes: their next owner is told that the one before ended without unlocking.
#pragma once

namespace waitpoint::posix {

/// Passes on the robust mutexes that the running thread holds at its end. Others stay locked.
void let_robust_mutexes_go();

}  // namespace waitpoint::posix
