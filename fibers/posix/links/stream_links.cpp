// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/links/stream_links.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/links/robot_links.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/cancellation.hpp"

namespace waitpoint::posix {
namespace {

/// Bytes that a stream may have under way, and of one message.
constexpr std::size_t most_under_way = std::size_t{256} * 1024, most_of_a_piece = std::size_t{16} * 1024;
/// Bytes charged for each piece in addition to its data.
constexpr std::size_t around_a_piece = 64;
static_assert(most_of_a_piece + around_a_piece <= most_under_way,
              "a stream with nothing under way has room for a piece");

/// A sending socket with the data under way from it.
struct Stream {
  explicit Stream(int of) : descriptor(of) {}
  int descriptor;                  ///< the program's; -1 once it is closed
  int own = -1;                    ///< our duplicate
  const void* receiver = nullptr;  ///< the carrier's; null: it goes over no link
  std::size_t under_way = 0;
  struct Piece* first_arrived = nullptr;
  struct Piece* last_arrived = nullptr;
  int pieces = 0;  ///< references: its pieces, and calls in progress
  bool has_ended = false;
  kernel::Object object{"stream"};  ///< of writers waiting for room
  Stream* next = nullptr;
};
Stream* first = nullptr;
int arrived_count = 0;  // pieces that have arrived and are not written yet, for lack of room

/// A piece of a stream; its bytes follow the record. The end of the stream is a piece without bytes.
struct Piece {
  Stream* stream;
  std::size_t size;
  bool has_arrived = false;
  bool is_kept = true;  ///< the link refers to it
  std::size_t taken = 0;
  Piece* next = nullptr;
  char* bytes() { return reinterpret_cast<char*>(this + 1); }
};

void free_if_unused(Stream& stream) {
  if (stream.descriptor >= 0 || stream.pieces > 0) return;
  WAITPOINT_CHECK(stream.first_arrived == nullptr && stream.under_way == 0, "a stream with data under way is freed");
  Stream** link = &first;
  while (*link != nullptr && *link != &stream) link = &(*link)->next;
  WAITPOINT_CHECK(*link == &stream, "a stream to be freed is not in the list");
  *link = stream.next;
  if (stream.own >= 0) WAITPOINT_NEXT(close)(stream.own);
  std::free(&stream);
}

// It is no longer under way; freed here unless the link refers to it.
void let_go(Piece& piece) {
  WAITPOINT_CHECK(piece.stream != nullptr, "a piece of a stream is freed twice");
  Stream& stream = *piece.stream;
  WAITPOINT_CHECK(stream.under_way >= piece.size + around_a_piece && stream.pieces > 0,
                  "a stream has less under way than the size of a piece");
  stream.under_way -= piece.size + around_a_piece;
  --stream.pieces;
  piece.stream = nullptr;
  if (!piece.is_kept) std::free(&piece);
  free_if_unused(stream);
}

// Writes as much as the socket accepts; true if that is all. Data that the other end rejects is dropped.
bool is_taken(Piece& piece) {
  const int own = piece.stream->own;
  WAITPOINT_CHECK(own >= 0 && piece.taken <= piece.size,
                  "a piece of a stream has no socket, or was written beyond its end");
  if (piece.size == 0) {
    WAITPOINT_NEXT(shutdown)(own, SHUT_WR);
    return true;
  }
  while (piece.taken < piece.size) {
    const ssize_t count =
        WAITPOINT_NEXT(send)(own, piece.bytes() + piece.taken, piece.size - piece.taken, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count < 0) return errno != EAGAIN;
    piece.taken += static_cast<std::size_t>(count);
  }
  return true;
}

// Writes the pieces that have arrived, in order, while there is room.
void deliver(Stream& stream) {
  ++stream.pieces;  // a reference: it must outlive the loop
  while (Piece* const piece = stream.first_arrived) {
    if (!is_taken(*piece)) break;
    WAITPOINT_CHECK(piece->stream == &stream && arrived_count > 0, "a piece of another stream has arrived");
    stream.first_arrived = piece->next;
    if (piece->next == nullptr) stream.last_arrived = nullptr;
    --arrived_count;
    let_go(*piece);
  }
  if (stream.object.first_waiter != nullptr) kernel::wake_all(*stream.object.first_waiter->scheduler, stream.object);
  --stream.pieces;
  free_if_unused(stream);
}

void arrive(void* message) {
  auto& piece = *static_cast<Piece*>(message);
  const ErrorNumberKept kept;
  WAITPOINT_CHECK(piece.stream != nullptr && !piece.has_arrived, "a piece of a stream arrives twice");
  Stream& stream = *piece.stream;
  WAITPOINT_CHECK((stream.first_arrived == nullptr) == (stream.last_arrived == nullptr),
                  "the ends of a stream's list of arrived pieces disagree");
  piece.has_arrived = true;
  (stream.last_arrived == nullptr ? stream.first_arrived : stream.last_arrived->next) = &piece;
  stream.last_arrived = &piece;
  ++arrived_count;
  before_look = deliver_streams;
  deliver(stream);
  if (arrived_count > 0 && await_room != nullptr) await_room();
  look_at_descriptors();
}

// A piece that has arrived belongs to the stream until it is written.
void drop(void* message) {
  auto& piece = *static_cast<Piece*>(message);
  const ErrorNumberKept kept;
  WAITPOINT_CHECK(piece.is_kept, "the link drops a piece of a stream twice");
  piece.is_kept = false;
  if (piece.stream == nullptr)
    std::free(&piece);
  else if (!piece.has_arrived)
    let_go(piece);
}

const void* receiver_of(int descriptor) {
  SocketAddress own, peer;
  if (type_of_socket(descriptor) != SOCK_STREAM || !take_own_address(descriptor, own)) return nullptr;
  if (own.bytes.ss_family != AF_INET && own.bytes.ss_family != AF_INET6) return nullptr;
  return take_peers_address(descriptor, peer) ? receiver_at(peer, SOCK_STREAM, &own) : nullptr;
}

Stream* known(int descriptor) {
  for (Stream* stream = first; stream != nullptr; stream = stream->next)
    if (stream->descriptor == descriptor) return stream;
  return nullptr;
}

// The stream of a connected socket; null without memory, or if it is not connected.
Stream* stream_of(int descriptor) {
  if (Stream* const found = known(descriptor); found != nullptr) return found;
  SocketAddress peer;
  if (!take_peers_address(descriptor, peer)) return nullptr;
  void* const memory = std::malloc(sizeof(Stream));
  if (memory == nullptr) return nullptr;
  auto* const stream = new (memory) Stream(descriptor);
  if ((stream->receiver = receiver_of(descriptor)) != nullptr &&
      (stream->own = WAITPOINT_NEXT(fcntl)(descriptor, F_DUPFD_CLOEXEC, 0)) < 0)
    stream->receiver = nullptr;
  stream->next = first;
  return first = stream;
}

// Sends a piece; false without memory or link.
bool launch(Stream& stream, const Carrier& carrier, const void* bytes, std::size_t size) {
  WAITPOINT_CHECK(size <= most_of_a_piece && stream.receiver != nullptr && stream.own >= 0,
                  "a piece is too large, or of a stream that goes over no link");
  void* const memory = std::malloc(sizeof(Piece) + size);
  if (memory == nullptr) return false;
  auto* const piece = new (memory) Piece{&stream, size};
  if (size > 0) std::memcpy(piece->bytes(), bytes, size);
  stream.under_way += size + around_a_piece;
  ++stream.pieces;
  if (carrier.carry_in_order(carrier.network, *this_program().robot, stream.receiver, size, arrive, drop, piece))
    return true;
  piece->is_kept = false;
  let_go(*piece);
  return false;
}

// True if the system reports an error of the stream: then writing to it fails by the system's call.
bool has_failed(int descriptor) {
  pollfd one{descriptor, 0, 0};
  return WAITPOINT_NEXT(poll)(&one, 1, 0) > 0;
}

// Waits for room, even if the socket is non-blocking; false, with EINTR, if a signal interrupted the wait.
bool wait_for_room(Stream& stream) {
  const CancellationPoint point;
  kernel::enter(stream.object);
  while (stream.under_way >= most_under_way) {
    const Wait ended = point.block(stream.object, Time::max());
    leave_if_cancelled();
    if (ended == Wait::interrupted && is_interrupted(Restart::if_asked)) return fail(EINTR) == 0;
  }
  return true;
}

}  // namespace

void (*await_room)() = nullptr;

bool goes_over_link(int descriptor) {
  if (carrier_here() == nullptr) return false;
  const Stream* const stream = stream_of(descriptor);
  return stream != nullptr && stream->receiver != nullptr && !has_failed(descriptor);
}

ssize_t send_stream_over_link(int descriptor, const void* bytes, std::size_t size) {
  Stream* const found = stream_of(descriptor);
  if (found == nullptr || found->receiver == nullptr) return fail(EBADF);  // closed between the parts of a message
  Stream& stream = *found;
  if (stream.has_ended) return fail(EPIPE);
  const char* const from = static_cast<const char*>(bytes);
  std::size_t sent = 0;
  ++stream.pieces;  // a reference: another thread may close it meanwhile
  pass(kernel::Operation::send, nullptr);
  while (sent < size && stream.descriptor >= 0 && wait_for_room(stream) && stream.descriptor >= 0) {
    const std::size_t piece = size - sent < most_of_a_piece ? size - sent : most_of_a_piece;
    if (!launch(stream, *carrier_here(), from + sent, piece)) break;
    sent += piece;
  }
  --stream.pieces;
  free_if_unused(stream);
  if (sent > 0) return static_cast<ssize_t>(sent);
  return errno == EINTR ? -1 : fail(ENOBUFS);
}

bool end_stream_over_link(int descriptor) {
  if (!goes_over_link(descriptor)) return false;
  Stream& stream = *stream_of(descriptor);
  const bool is_first = !stream.has_ended;
  stream.has_ended = true;
  return !is_first || launch(stream, *carrier_here(), nullptr, 0);
}

void close_stream_over_link(int descriptor) {
  Stream* const stream = known(descriptor);
  if (stream == nullptr) return;
  const ErrorNumberKept kept;
  const Carrier* const carrier = carrier_here();
  if (carrier != nullptr && stream->receiver != nullptr && !stream->has_ended) launch(*stream, *carrier, nullptr, 0);
  stream->descriptor = -1;
  free_if_unused(*stream);
}

void deliver_streams() {
  if (arrived_count == 0) return;
  const ErrorNumberKept kept;
  for (Stream *stream = first, *next = nullptr; stream != nullptr; stream = next) {
    next = stream->next;
    if (stream->first_arrived != nullptr) deliver(*stream);
  }
  if (arrived_count > 0 && await_room != nullptr) await_room();
}

// Pieces on the link are dropped with the link.
void forget_streams() {
  for (Stream *stream = first, *next = nullptr; stream != nullptr; stream = next) {
    next = stream->next;
    ++stream->pieces;
    while (Piece* const piece = stream->first_arrived) {
      WAITPOINT_CHECK(arrived_count > 0, "more pieces of streams have arrived than were counted");
      stream->first_arrived = piece->next;
      --arrived_count;
      let_go(*piece);
    }
    stream->last_arrived = nullptr;
    --stream->pieces;
    stream->descriptor = -1;
    free_if_unused(*stream);
  }
}

}  // namespace waitpoint::posix
