// SPDX-License-Identifier: BSD-3-Clause
// The descriptors inside: pipes, sockets, eventfds of which only this program, with the processes of its family, has
// the ends. See descriptors.hpp.
//
// A pipe inside is counted while all its bytes pass through read() and write() of the simulation: the number of bytes
// in it is then known without a system call. The C library's streams, splices, duplicates made by other means and
// changes of its flags end that for good.
#pragma once

#include <poll.h>
#include <sys/types.h>

#include <cstddef>
#include <cstdint>

#include "fibers/posix/descriptors/owners.hpp"

namespace waitpoint::posix {

/// A pipe or a socket inside, in the family's memory.
struct InsideFile {
  ino_t inode;
  int held;       ///< bytes in the pipe: now, if it is counted, otherwise at the last check, by any process
  int pages;      ///< at most so many pages of a counted pipe are in use
  int pages_max;  ///< its capacity
  bool is_counted;
  bool is_pipe;
  std::uint32_t number;     ///< in the order of first sight: the inode differs from run to run
  bool has_stream = false;  ///< a FILE* writes to it by calls within the C library
};

/// The bytes for which the counted pipe is known to have room.
std::size_t room_in(const InsideFile& pipe);
/// True if an end of the counted pipe is known to be ready; else it may be, if the other end is closed.
inline bool is_ready(const InsideFile& pipe, short events) {
  return events == POLLIN ? pipe.held > 0 : room_in(pipe) > 0;
}
/// After bytes were written or read; null: to or from a pipe that is not counted.
void note_written(InsideFile* pipe, std::size_t bytes);
void note_read(InsideFile* pipe, std::size_t bytes);

/// Inside: made by this program for itself, or a duplicate of such a descriptor. Not inside: closed, or shared.
void note_inside(int descriptor, bool inside);
/// The ends of a pipe that was just made.
void note_pipe(const int (&ends)[2], int flags);
/// `made` is a duplicate of `from`. A standard stream is passed to notice_stream(), unless null, which is to let the
/// C library's calls on it be noticed.
extern void (*notice_stream)(int descriptor);
void note_duplicate(int from, int made);
bool is_inside(int descriptor);

/// Outside: its reader did not read when it was last waited for, since the descriptor was made.
bool was_waited_for_in_vain(int descriptor);
void note_waited_for_in_vain(int descriptor);

/// The pipe, if `descriptor` is the given end of a counted one; else null.
InsideFile* counted_pipe(int descriptor, short events);
inline bool is_counted_pipe(int descriptor) {
  return counted_pipe(descriptor, POLLIN) != nullptr || counted_pipe(descriptor, POLLOUT) != nullptr;
}
/// The pipe, counted or not, of which `descriptor` is an end; else null.
const InsideFile* pipe_inside(int descriptor);
/// From now on its bytes may change by other means.
void end_counting(int descriptor);
/// By calls within the C library, which are not noticed.
void note_stream(int descriptor);
void end_counting_of_inode(ino_t inode);
/// Of all, as duplicates may be passed to another process, which can find them by note_received().
void end_counting_of_all();

/// A program that is to be started gets a duplicate, though the descriptor itself is closed as it starts.
void note_passed_on(int descriptor);
/// Before a program is started. A simulated one finds the pipes and sockets inside that were inside here; a native one
/// makes those outside that it gets.
void note_start(bool is_native);
/// In a program that was started: see there.
void inherit_inside();
/// The descriptor was received from another process: it is inside if its pipe or socket is.
void note_received(int descriptor);

/// True if a pipe or socket inside may have been written to by the C library.
bool may_have_unnoticed_output();
/// True if one of them holds another number of bytes than at the last call.
bool has_unnoticed_output();

}  // namespace waitpoint::posix
