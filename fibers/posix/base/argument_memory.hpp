// SPDX-License-Identifier: BSD-3-Clause
// Checks of the addresses passed to a call: system calls fail with EFAULT where ours would crash.
#pragma once

#include <cstddef>

namespace waitpoint::posix {

/// True if the first eight bytes are readable. A system call, of less than a tenth of a microsecond.
bool can_be_read(const void* address);
/// True if the first eight bytes are writable; overwrites them.
bool can_be_written(void* address);
/// The same for `size` bytes, at least one.
bool can_be_written(void* address, std::size_t size);

}  // namespace waitpoint::posix
