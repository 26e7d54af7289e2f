// SPDX-License-Identifier: BSD-3-Clause
// Thread-specific data. The C library keeps the values, in each thread's area; what it does at a thread's end is done
// here, since it does not know when our threads end.
#pragma once

namespace waitpoint::posix {

/// Calls the destructors of the running thread's values, as POSIX says: again while values are left, a few times.
void destroy_values_of_keys();

}  // namespace waitpoint::posix
