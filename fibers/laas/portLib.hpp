// SPDX-License-Identifier: BSD-3-Clause
// The words that all of pocolibs shares: what calls return, and the error code that each task keeps of its last call
// that failed (VxWorks' errno, not the C library's).
//
// The names are pocolibs' own, so that its clients change by a namespace. There is one h2 name space, one clock and one
// table of tasks per robot and run; nothing is shared between robots.
#pragma once

namespace waitpoint::laas {

using STATUS = int;
inline constexpr STATUS OK = 0;
inline constexpr STATUS ERROR = -1;

using BOOL = int;
inline constexpr BOOL FALSE = 0;
inline constexpr BOOL TRUE = 1;

/// Time-outs in ticks, where a positive one is not meant. comLib reads 0 as for ever, too: see h2semLib.hpp.
inline constexpr int WAIT_FOREVER = -1;
inline constexpr int NO_WAIT = 0;

/// An error code: the number of its library, and its own there. Below 1 << 16 they are the C library's (EINVAL, ...).
constexpr int H2_ENCODE_ERR(int library, int error) { return library << 16 | error; }

inline constexpr int S_portLib_NO_MEMORY = H2_ENCODE_ERR(1, 1);
inline constexpr int S_portLib_NO_SUCH_TASK = H2_ENCODE_ERR(1, 2);
inline constexpr int S_portLib_INVALID_TASKID = H2_ENCODE_ERR(1, 4);
inline constexpr int S_portLib_NOT_IMPLEMENTED = H2_ENCODE_ERR(1, 5);

/// The error code of the caller's last call that failed; 0 before any did.
int errnoGet();
STATUS errnoSet(int error);

/// Sets the caller's error code; always ERROR.
STATUS fail(int error);

}  // namespace waitpoint::laas
