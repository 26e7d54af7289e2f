// SPDX-License-Identifier: BSD-3-Clause
// What threads of simulated processes wait for, as one of these processes sees it: functions of the layer of `waitpoint
// exec`, which others find by their names, with dlsym(). C++17.
#pragma once

namespace waitpoint {

/// A wait that has not ended: for a lock that another thread holds, or one that was told.
struct LastingWait {
  char thread[96];  ///< "mapper#1002: thread 3"
  char what[160];   ///< "a mutex that mapper#1002: thread 4 holds", "the service /where"
  bool is_told;
  long long lasts_ns;  ///< by now, in virtual time
};

/// Waits are noted from now on, in all processes.
using NoteWaits = void();
inline constexpr const char* note_waits = "waitpoint_note_waits";

/// The calling thread begins a wait, which it tells; what is returned ends it. Negative: waits are not noted.
using BeginWait = int(const char* what);
inline constexpr const char* begin_wait = "waitpoint_begin_wait";
using EndWait = void(int wait);
inline constexpr const char* end_wait = "waitpoint_end_wait";

/// The first wait from this place on, in the order of places; returns the place after it, or a negative number if there
/// is none.
using NextWait = int(int place, LastingWait* wait);
inline constexpr const char* next_wait = "waitpoint_next_wait";

}  // namespace waitpoint
