// SPDX-License-Identifier: BSD-3-Clause
// File locks, held by another process, or by another thread through another open file description.
#pragma once

#include <fcntl.h>

namespace waitpoint::posix {

/// As fcntl() by F_SETLKW or F_OFD_SETLKW.
int lock_waiting(int descriptor, int command, const struct flock& lock);

}  // namespace waitpoint::posix
