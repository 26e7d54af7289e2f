// SPDX-License-Identifier: BSD-3-Clause
// What is particular of sockets.
#pragma once

#include <sys/types.h>

#include <cstddef>

namespace waitpoint::posix {

/// Whether what is sent is a stream, of which a part may be taken.
bool is_stream(int descriptor);
/// As send(), for a stream.
ssize_t send_to_stream(int descriptor, const void* bytes, std::size_t size, int flags);

}  // namespace waitpoint::posix
