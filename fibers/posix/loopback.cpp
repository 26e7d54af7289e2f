// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/loopback.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <bitset>

#include "fibers/posix/argument_memory.hpp"
#include "fibers/posix/descriptors.hpp"
#include "fibers/posix/error_number.hpp"
#include "fibers/posix/interposed.hpp"

namespace waitpoint::posix {
namespace {

constexpr int longest_queue = 4096;    // of connections; the system has none that is longer
constexpr int least_buffer = 1 << 16;  // bytes: a segment of the loopback fits

// Whether the program itself asked for no delay, by descriptor.
constinit std::bitset<known_descriptors_max> asked_for_none;

bool is_known(int descriptor) { return descriptor >= 0 && descriptor < known_descriptors_max; }

bool is_tcp(int descriptor) {
  int protocol = 0;
  socklen_t size = sizeof protocol;
  const ErrorNumberKept kept;
  return WAITPOINT_NEXT(getsockopt)(descriptor, SOL_SOCKET, SO_PROTOCOL, &protocol, &size) == 0 &&
         protocol == IPPROTO_TCP;
}

bool is_about_delay(int descriptor, int level, int option) {
  return level == IPPROTO_TCP && option == TCP_NODELAY && is_known(descriptor) && is_tcp(descriptor);
}

bool is_about_buffer(int descriptor, int level, int option) {
  return level == SOL_SOCKET && (option == SO_RCVBUF || option == SO_SNDBUF) && is_tcp(descriptor);
}

}  // namespace

void send_at_once(int descriptor) {
  if (!is_known(descriptor) || !is_tcp(descriptor)) return;
  asked_for_none[static_cast<std::size_t>(descriptor)] = false;
  constexpr int on = 1;
  WAITPOINT_NEXT(setsockopt)(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

void copy_delay(int from, int made) {
  if (is_known(from) && is_known(made))
    asked_for_none[static_cast<std::size_t>(made)] = asked_for_none[static_cast<std::size_t>(from)];
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int listen(int descriptor, int most) noexcept {
  return WAITPOINT_NEXT(listen)(descriptor, is_simulated() && is_tcp(descriptor) ? longest_queue : most);
}

WAITPOINT_INTERPOSED int setsockopt(int descriptor, int level, int option, const void* value, socklen_t size) noexcept {
  const bool has_number = is_simulated() && size >= sizeof(int) && can_be_read(value);
  if (has_number && is_about_delay(descriptor, level, option)) {
    asked_for_none[static_cast<std::size_t>(descriptor)] = *static_cast<const int*>(value) != 0;
    return 0;
  }
  if (has_number && is_about_buffer(descriptor, level, option)) {
    const int bytes = std::max(*static_cast<const int*>(value), least_buffer);
    return WAITPOINT_NEXT(setsockopt)(descriptor, level, option, &bytes, sizeof bytes);
  }
  return WAITPOINT_NEXT(setsockopt)(descriptor, level, option, value, size);
}

WAITPOINT_INTERPOSED int getsockopt(int descriptor, int level, int option, void* __restrict value,
                                    socklen_t* __restrict size) noexcept {
  const int result = WAITPOINT_NEXT(getsockopt)(descriptor, level, option, value, size);
  if (result == 0 && is_simulated() && *size == sizeof(int) && is_about_delay(descriptor, level, option))
    *static_cast<int*>(value) = asked_for_none[static_cast<std::size_t>(descriptor)] ? 1 : 0;
  return result;
}
