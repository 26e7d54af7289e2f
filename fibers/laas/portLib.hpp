// SPDX-License-Identifier: BSD-3-Clause
// Common definitions of pocolibs: return values, and each task's error code of its last failed call (VxWorks' errno,
// not the C library's).
//
// The names are pocolibs' own, so that its clients change by a namespace. There is one h2 name space, one clock and one
// table of tasks per robot and run; robots share nothing.
#pragma once

namespace waitpoint::laas {

using STATUS = int;
inline constexpr STATUS OK = 0;
inline constexpr STATUS ERROR = -1;

using BOOL = int;
inline constexpr BOOL FALSE = 0;
inline constexpr BOOL TRUE = 1;

/// Special time-outs, in ticks. comLib treats 0 as for ever, too: see h2semLib.hpp.
inline constexpr int WAIT_FOREVER = -1;
inline constexpr int NO_WAIT = 0;

/// An error code: the library's number, and the error's number in it. Below 1 << 16 they are the C library's (EINVAL,
/// ...).
constexpr int H2_ENCODE_ERR(int library, int error) { return library << 16 | error; }

inline constexpr int S_portLib_NO_MEMORY = H2_ENCODE_ERR(1, 1);
inline constexpr int S_portLib_NO_SUCH_TASK = H2_ENCODE_ERR(1, 2);
inline constexpr int S_portLib_INVALID_TASKID = H2_ENCODE_ERR(1, 4);
inline constexpr int S_portLib_NOT_IMPLEMENTED = H2_ENCODE_ERR(1, 5);

/// The error code of the caller's last failed call; 0 if there was none.
int errnoGet();
STATUS errnoSet(int error);

/// Sets the caller's error code; always ERROR.
STATUS fail(int error);

}  // namespace waitpoint::laas
