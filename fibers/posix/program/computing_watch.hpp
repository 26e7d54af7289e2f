// SPDX-License-Identifier: BSD-3-Clause
// Threads that compute without calls although something is to interrupt them: a timer on their processor time, or an
// asynchronous cancellation.
#pragma once

namespace waitpoint::posix {

/// Called, unless null, when a thread may be interrupted so from now on.
extern void (*expect_computing)();

}  // namespace waitpoint::posix
