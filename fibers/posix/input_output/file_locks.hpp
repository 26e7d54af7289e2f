// SPDX-License-Identifier: BSD-3-Clause
// Locks on files, which another process may have, or another thread by another opening of the file.
#pragma once

#include <fcntl.h>

namespace waitpoint::posix {

/// As fcntl() by F_SETLKW or F_OFD_SETLKW.
int lock_waiting(int descriptor, int command, const struct flock& lock);

}  // namespace waitpoint::posix
