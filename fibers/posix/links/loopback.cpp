// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/links/loopback.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/descriptors/partners.hpp"
#include "fibers/posix/program/state_calls.hpp"

namespace waitpoint::posix {
namespace {

constexpr int longest_queue = 4096;  // of connections; the system's maximum
// Bytes. The data sent and not acknowledged fits into the receive buffer, and is few segments, so that the system never
// measures the speed and adapts the amount sent at once.
constexpr int sent_most = 1 << 15, received_most = 1 << 16;
static_assert(sent_most < received_most, "the receiver has room for all data that is not acknowledged");

struct LoopbackStream {
  bool is_at_once : 1;  ///< the system delays nothing
  bool asked_for : 1;   ///< TCP_NODELAY as set by the program
};
// Indexed by descriptor.
constinit LoopbackStream streams[known_descriptors_max]{};

bool is_known(int descriptor) { return descriptor >= 0 && descriptor < known_descriptors_max; }

bool is_tcp(int descriptor) {
  int protocol = 0;
  socklen_t size = sizeof protocol;
  const ErrorNumberKept kept;
  return WAITPOINT_NEXT(getsockopt)(descriptor, SOL_SOCKET, SO_PROTOCOL, &protocol, &size) == 0 &&
         protocol == IPPROTO_TCP;
}

bool is_about_delay(int level, int option) { return level == IPPROTO_TCP && option == TCP_NODELAY; }
bool is_about_buffer(int level, int option) {
  return level == SOL_SOCKET && (option == SO_RCVBUF || option == SO_SNDBUF);
}

}  // namespace

void send_at_once(int descriptor) {
  if (!is_known(descriptor) || !is_tcp(descriptor)) return;
  streams[descriptor].is_at_once = true;
  constexpr int on = 1;
  WAITPOINT_NEXT(setsockopt)(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  WAITPOINT_NEXT(setsockopt)(descriptor, SOL_SOCKET, SO_SNDBUF, &sent_most, sizeof sent_most);
  WAITPOINT_NEXT(setsockopt)(descriptor, SOL_SOCKET, SO_RCVBUF, &received_most, sizeof received_most);
}

bool sends_at_once(int descriptor) { return is_known(descriptor) && streams[descriptor].is_at_once; }

void acknowledge(int descriptor) {
  if (!sends_at_once(descriptor)) return;
  const ErrorNumberKept kept;
  constexpr int on = 1;
  WAITPOINT_NEXT(setsockopt)(descriptor, IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on);
}

void begin_as_asked(int descriptor) {
  if (is_known(descriptor)) streams[descriptor] = {};
}

void copy_asked(int from, int made) {
  if (is_known(from) && is_known(made)) streams[made] = streams[from];
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int listen(int descriptor, int most) noexcept {
  before_call<"listen">(reading(place::descriptors) | changing(place::channels));
  if (!is_simulated() || !is_tcp(descriptor)) return WAITPOINT_NEXT(listen)(descriptor, most);
  send_at_once(descriptor);
  const int result = WAITPOINT_NEXT(listen)(descriptor, longest_queue);
  note_listening(descriptor);
  return result;
}

WAITPOINT_INTERPOSED int setsockopt(int descriptor, int level, int option, const void* value, socklen_t size) noexcept {
  before_call<"setsockopt">(reading(place::descriptors) | changing(place::channels));
  const bool has_number = is_simulated() && size >= sizeof(int) && can_be_read(value) && is_known(descriptor);
  if (has_number && is_about_delay(level, option) && is_tcp(descriptor)) {
    streams[descriptor].asked_for = *static_cast<const int*>(value) != 0;
    if (streams[descriptor].is_at_once) return 0;
  }
  if (has_number && streams[descriptor].is_at_once && is_about_buffer(level, option)) return 0;
  return WAITPOINT_NEXT(setsockopt)(descriptor, level, option, value, size);
}

WAITPOINT_INTERPOSED int getsockopt(int descriptor, int level, int option, void* __restrict value,
                                    socklen_t* __restrict size) noexcept {
  before_call<"getsockopt">(reading(place::descriptors) | reading(place::channels));
  const int result = WAITPOINT_NEXT(getsockopt)(descriptor, level, option, value, size);
  if (result == 0 && is_simulated() && *size == sizeof(int) && is_known(descriptor) && is_about_delay(level, option))
    *static_cast<int*>(value) = streams[descriptor].asked_for ? 1 : 0;
  return result;
}
