// SPDX-License-Identifier: BSD-3-Clause
// Streams of the internet protocols between programs of different robots: data goes over the link between the two
// robots, and is written into the socket when it arrives; so do the ends of streams. Nothing is lost.
//
//   write() --> under way: on the link, or arrived but without room at the reader --> the socket
//
// A writer with the maximum under way waits until some of it has been written.
#pragma once

#include <cstddef>

#include <sys/types.h>

namespace waitpoint::posix {

/// True if data that the running thread writes to the socket goes over a link.
bool goes_over_link(int descriptor);
/// As send(), for a socket that goes over a link.
ssize_t send_stream_over_link(int descriptor, const void* bytes, std::size_t size);
/// Ends the stream: the other end learns of it after the data under way. False if it goes over no link.
bool end_stream_over_link(int descriptor);
/// Before the close of a descriptor: ends its stream, if it has one.
void close_stream_over_link(int descriptor);
/// Writes arrived data: a reader may have made room.
void deliver_streams();
/// Called, unless null, while a reader, in another process, has no room for arrived data: to deliver it later.
extern void (*await_room)();
/// Frees all streams: data under way never arrives.
void forget_streams();

}  // namespace waitpoint::posix
