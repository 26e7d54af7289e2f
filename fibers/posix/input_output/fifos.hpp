// SPDX-License-Identifier: BSD-3-Clause
// Named pipes: opening one end waits until the other is open.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// True if opening `path` with these flags may wait for the other end.
bool is_fifo_to_wait_for(int folder, const char* path, int flags);
/// As openat(), for such a path.
int open_fifo(int folder, const char* path, int flags);

}  // namespace waitpoint::posix
