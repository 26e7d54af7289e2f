// SPDX-License-Identifier: BSD-3-Clause
// signalfd(): descriptors from which signals are read. Each is an eventfd, readable while one of its signals is
// pending, so that poll() and epoll work.
#pragma once

#include <cstddef>

#include <sys/types.h>

namespace waitpoint::posix {

/// Makes each readable or not, according to the pending signals.
void show_signal_descriptors();
/// After the close of a descriptor; no effect on other kinds.
void forget_signal_descriptor(int descriptor);
bool is_signal_descriptor(int descriptor);
/// Reads signals pending for the running thread: as read(), EAGAIN without any.
ssize_t read_signals(int descriptor, void* bytes, std::size_t size);

}  // namespace waitpoint::posix
