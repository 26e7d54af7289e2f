// SPDX-License-Identifier: BSD-3-Clause
// Operations on stream sockets.
#pragma once

#include <sys/types.h>

#include <cstddef>

namespace waitpoint::posix {

/// True for a stream socket, which may accept a part of the data.
bool is_stream(int descriptor);
/// As send(), for a stream.
ssize_t send_to_stream(int descriptor, const void* bytes, std::size_t size, int flags);

}  // namespace waitpoint::posix
