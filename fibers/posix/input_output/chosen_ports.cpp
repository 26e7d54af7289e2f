// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/input_output/chosen_ports.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>

#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/internet_address.hpp"
#include "fibers/posix/descriptors/partners.hpp"
#include "fibers/posix/family/family.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"

namespace waitpoint::posix {
namespace {

// The system's own range.
constexpr unsigned first_port = 32768, ports_count = 28232;

// Null if it is no internet address.
in_port_t* port_in(InternetAddress& address, socklen_t length) {
  if (address.any.sa_family == AF_INET && length >= sizeof(sockaddr_in)) return &address.internet.sin_port;
  if (address.any.sa_family == AF_INET6 && length >= sizeof(sockaddr_in6)) return &address.internet_6.sin6_port;
  return nullptr;
}

bool chooses_ports() { return is_simulated() && !has_host && record->settings.own_machine; }

// As bind(), to the next port that is free.
int bind_to_next(int descriptor, InternetAddress& address, socklen_t length) {
  auto* const chosen = static_cast<unsigned*>(family::common(family::Part::chosen_ports, sizeof(unsigned)));
  in_port_t* const port = port_in(address, length);
  for (unsigned tried = 0; tried < ports_count; ++tried) {
    *port = htons(static_cast<in_port_t>(first_port + (*chosen)++ % ports_count));
    const int result = WAITPOINT_NEXT(bind)(descriptor, &address.any, length);
    if (result == 0 || errno != EADDRINUSE) return result;
  }
  return -1;
}

int bind_as_asked(int descriptor, const sockaddr* address, socklen_t length) {
  InternetAddress asked{};
  if (!chooses_ports() || !can_be_read(address) || length > sizeof asked)
    return WAITPOINT_NEXT(bind)(descriptor, address, length);
  std::memcpy(&asked, address, length);
  const in_port_t* const port = port_in(asked, length);
  if (port == nullptr || *port != 0) return WAITPOINT_NEXT(bind)(descriptor, address, length);
  return bind_to_next(descriptor, asked, length);
}

}  // namespace

void bind_to_next_port(int descriptor) {
  if (!chooses_ports()) return;
  const ErrorNumberKept kept;
  InternetAddress own{};
  socklen_t length = sizeof own;
  if (WAITPOINT_NEXT(getsockname)(descriptor, &own.any, &length) != 0) return;
  if (const in_port_t* const port = port_in(own, length); port != nullptr && *port == 0)
    bind_to_next(descriptor, own, length);
}

}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

WAITPOINT_INTERPOSED int bind(int descriptor, const sockaddr* address, socklen_t length) noexcept {
  before_call<"bind">(reading(place::descriptors) | changing(place::channels));
  const int result = bind_as_asked(descriptor, address, length);
  if (result == 0 && is_simulated()) note_bound(descriptor);
  return result;
}
