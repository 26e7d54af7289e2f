// SPDX-License-Identifier: BSD-3-Clause
// Named pipes: who opens one end waits until somebody has the other.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// Whether opening `path` so may wait for somebody else.
bool is_fifo_to_wait_for(int folder, const char* path, int flags);
/// As openat(), for such a path.
int open_fifo(int folder, const char* path, int flags);

}  // namespace waitpoint::posix
