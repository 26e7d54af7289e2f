// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/links/datagram_medium.hpp"

#include <netinet/in.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/high_descriptor.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/links/robot_links.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/randomness.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::size_t largest_payload =
    65507;  // of UDP over IPv4; larger ones are left to the system, which rejects them

/// A datagram under way; the address, the control data and the bytes follow the record.
struct Underway {
  Underway* next;
  Time arrival;
  int descriptor;  // our duplicate of the sending socket's
  msghdr message;
  iovec part;
};

Underway* first_underway = nullptr;
/// The arrival of the first.
struct Arrival {
  kernel::EventNode event;
  kernel::Object object{"medium"};
} arrival;

bool is_udp(int descriptor) {
  int protocol = 0;
  socklen_t size = sizeof protocol;
  const ErrorNumberKept kept;
  return type_of_socket(descriptor) == SOCK_DGRAM &&
         WAITPOINT_NEXT(getsockopt)(descriptor, SOL_SOCKET, SO_PROTOCOL, &protocol, &size) == 0 &&
         protocol == IPPROTO_UDP;
}

bool is_lost(double loss) {
  constexpr double unit = 1.0 / 9007199254740992.0;  // 2^-53
  return loss > 0 && static_cast<double>(draw_random(Numbers::of_datagrams) >> 11) * unit < loss;
}

Duration drawn_delay(const Medium& medium) {
  const auto width = static_cast<std::uint64_t>((medium.delay_greatest - medium.delay_least).ns());
  if (width == 0) return medium.delay_least;
  const std::uint64_t more = draw_random(Numbers::of_datagrams) % (width + 1);
  return medium.delay_least + Duration::from_ns(static_cast<std::int64_t>(more));
}

// Null without memory or a descriptor.
Underway* copy_of(int descriptor, const msghdr& message, std::size_t size) {
  const std::size_t bytes = message.msg_namelen + message.msg_controllen + size;
  auto* const memory = static_cast<Underway*>(std::malloc(sizeof(Underway) + bytes));
  if (memory == nullptr) return nullptr;
  const int copy = move_up(WAITPOINT_NEXT(dup)(descriptor));
  if (copy < 0) {
    std::free(memory);
    return nullptr;
  }
  auto* const made = new (memory) Underway{nullptr, Time(), copy, message, {}};
  auto* at = reinterpret_cast<char*>(made + 1);
  const auto take = [&](const void* from, std::size_t count) {
    void* const to = at;
    if (count > 0) std::memcpy(to, from, count);
    at += count;
    return to;
  };
  // The control data first: its records are aligned.
  made->message.msg_control = take(message.msg_control, message.msg_controllen);
  made->message.msg_name = take(message.msg_name, message.msg_namelen);
  if (message.msg_namelen == 0) made->message.msg_name = nullptr;
  made->part = {at, size};
  for (std::size_t i = 0; i < message.msg_iovlen; ++i) take(message.msg_iov[i].iov_base, message.msg_iov[i].iov_len);
  made->message.msg_iov = &made->part;
  made->message.msg_iovlen = 1;
  return made;
}

void deliver_first() {
  Underway* const datagram = first_underway;
  first_underway = datagram->next;
  const ErrorNumberKept kept;
  WAITPOINT_NEXT(sendmsg)(datagram->descriptor, &datagram->message, MSG_DONTWAIT | MSG_NOSIGNAL);
  WAITPOINT_NEXT(close)(datagram->descriptor);
  std::free(datagram);
}

void await_first(kernel::Scheduler& scheduler) {
  if (arrival.event.in_list()) kernel::cancel(scheduler, arrival.event);
  if (first_underway != nullptr) kernel::schedule(scheduler, arrival.event, first_underway->arrival, arrival.object);
}

void arrive(kernel::EventNode&) {
  kernel::Scheduler& scheduler = *arrival.object.robot->scheduler;
  WAITPOINT_CHECK(first_underway != nullptr && first_underway->arrival <= kernel::global_time(scheduler),
                  "a datagram arrives that is not under way");
  while (first_underway != nullptr && first_underway->arrival <= kernel::global_time(scheduler)) deliver_first();
  await_first(scheduler);
  look_at_descriptors();
}

void put_under_way(Underway& datagram) {
  Underway** link = &first_underway;
  while (*link != nullptr && (*link)->arrival <= datagram.arrival) link = &(*link)->next;
  datagram.next = *link;
  *link = &datagram;
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  arrival.event.fire = arrive;
  kernel::enter(arrival.object);
  if (first_underway == &datagram) await_first(scheduler);
}

}  // namespace

bool send_through_medium(int descriptor, const msghdr& message, std::size_t& size) {
  if (!is_simulated() || has_host) return false;
  const Medium& medium = record->settings.medium;
  if (!medium.is_declared() || !is_udp(descriptor)) return false;
  size = 0;
  for (std::size_t i = 0; i < message.msg_iovlen; ++i)
    if (__builtin_add_overflow(size, message.msg_iov[i].iov_len, &size) || size > largest_payload) return false;
  if (is_lost(medium.loss)) {
    pass(kernel::Operation::send, nullptr);
    return true;
  }
  const Duration delay = drawn_delay(medium);
  if (delay == Duration()) return false;
  Underway* const datagram = copy_of(descriptor, message, size);
  if (datagram == nullptr) return false;
  pass(kernel::Operation::send, nullptr);
  datagram->arrival = kernel::local_time(*kernel::running) + delay;
  put_under_way(*datagram);
  return true;
}

void deliver_datagrams() {
  if (first_underway == nullptr) return;
  while (first_underway != nullptr) deliver_first();
  if (arrival.event.in_list()) kernel::cancel(*arrival.object.robot->scheduler, arrival.event);
  look_at_descriptors();
}

void forget_datagrams() {
  while (first_underway != nullptr) {
    Underway* const datagram = first_underway;
    first_underway = datagram->next;
    WAITPOINT_NEXT(close)(datagram->descriptor);
    std::free(datagram);
  }
  if (arrival.event.in_list()) kernel::cancel(*kernel::running->scheduler, arrival.event);
}

}  // namespace waitpoint::posix
