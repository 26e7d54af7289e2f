// SPDX-License-Identifier: BSD-3-Clause
// Streams of the internet's protocols between programs of different robots: what one writes goes over the link between
// the two robots, and is written into the socket when it arrives there; so do its end and its closing. Nothing is lost.
//
//   write() --> under way: on the link, or arrived where the reader has left no room --> the socket
//
// Who has as much under way as a stream may have waits until some of it has been taken.
#pragma once

#include <cstddef>

#include <sys/types.h>

namespace waitpoint::posix {

/// Whether what the running thread writes to a socket goes over a link.
bool goes_over_link(int descriptor);
/// To such a one: as send().
ssize_t send_stream_over_link(int descriptor, const void* bytes, std::size_t size);
/// Nothing more is written to it: the other end learns of that behind what is under way. False: it goes over no link.
bool end_stream_over_link(int descriptor);
/// It is about to be closed, if it is one: as the end, whatever becomes of the descriptor.
void close_stream_over_link(int descriptor);
/// A reader may have made room.
void deliver_streams();
/// All of them: what is under way never arrives.
void forget_streams();

}  // namespace waitpoint::posix
