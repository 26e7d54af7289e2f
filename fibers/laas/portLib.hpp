// SPDX-License-Identifier: BSD-3-Clause
// Common definitions of pocolibs: return values, and each task's error code of its last failed call (VxWorks' errno,
// not the C library's).
//
// The functions have pocolibs' names in a namespace; types, values and error codes are those of pocolibs' headers,
// which are macros. There is one h2 name space, one clock and one table of tasks per robot and run; robots share
// nothing.
#pragma once

#include "fibers/laas/include/portLib.h"

namespace waitpoint::laas {

/// The error code of the caller's last failed call; 0 if there was none.
int errnoGet();
STATUS errnoSet(int error);

/// Sets the caller's error code; always ERROR.
STATUS fail(int error);

}  // namespace waitpoint::laas
