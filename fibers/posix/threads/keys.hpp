// SPDX-License-Identifier: BSD-3-Clause
// Thread-specific data. The C library keeps the values, in each thread's area; the destructors are called here, since
// it does not know when our threads end.
#pragma once

namespace waitpoint::posix {

/// Calls the destructors of the running thread's values, in POSIX's few rounds while values are left.
void destroy_values_of_keys();

}  // namespace waitpoint::posix
