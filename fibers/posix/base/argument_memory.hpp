// SPDX-License-Identifier: BSD-3-Clause
// Whether an address that a call is given can be used: the system's calls fail with EFAULT where ours would crash.
#pragma once

#include <cstddef>

namespace waitpoint::posix {

/// Asks the system, which takes less than a tenth of a microsecond: of the first eight bytes.
bool can_be_read(const void* address);
/// Of what is to be overwritten: these bytes are.
bool can_be_written(void* address);
/// The same of so many bytes, more than none.
bool can_be_written(void* address, std::size_t size);

}  // namespace waitpoint::posix
