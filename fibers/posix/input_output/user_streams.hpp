// SPDX-License-Identifier: BSD-3-Clause
// Standard output and standard error where they are the user's: a terminal, a device, a pipe to a program outside. Like
// a file's, their use is no event, so that a run is the same wherever its output goes. They may hold it up in real
// time.
#pragma once

#include <sys/types.h>

#include <cstddef>

namespace waitpoint::posix {

/// True for such a stream.
bool is_user_stream(int descriptor);
/// As write() to one. Returns less than `size`, or -1 with EAGAIN, if a pipe's reader takes nothing for a second: it
/// may wait for another thread of the program.
ssize_t write_to_user(int descriptor, const char* bytes, std::size_t size);

}  // namespace waitpoint::posix
