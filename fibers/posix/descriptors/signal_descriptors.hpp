// SPDX-License-Identifier: BSD-3-Clause
// signalfd(): descriptors that signals are read from. Beneath each is an eventfd, which can be read as long as one of
// its signals pends, so that poll() and epoll work.
#pragma once

#include <cstddef>

#include <sys/types.h>

namespace waitpoint::posix {

/// What can be read from each is what pends now.
void show_signal_descriptors();
/// It is closed, if it is one.
void forget_signal_descriptor(int descriptor);
bool is_signal_descriptor(int descriptor);
/// Reads what pends for the running thread: as read(), EAGAIN without anything.
ssize_t read_signals(int descriptor, void* bytes, std::size_t size);

}  // namespace waitpoint::posix
