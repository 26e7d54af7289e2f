// SPDX-License-Identifier: BSD-3-Clause
// The rights of the calling process, as the system checks them.
#pragma once

#include <sys/types.h>

namespace waitpoint::posix {

/// True if it is the process's effective group, or one of its supplementary ones.
bool is_in_group(gid_t group);

}  // namespace waitpoint::posix
