// SPDX-License-Identifier: BSD-3-Clause
// What reading, writing, sending and receiving have in common: where the system would block the thread, it waits for
// the descriptor first, and the call is made then.
#pragma once

#include <cstddef>
#include <cstdint>

#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/links/loopback.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::posix {

enum class DescriptorClass : std::uint8_t { file, pipe, socket, other };

/// Files are always ready, and their use is no event. Before main() all are taken for such.
DescriptorClass class_of(int descriptor);
/// Whether calls on it wait: without O_NONBLOCK.
bool blocks(int descriptor);
/// The same of a direction: not if it fails at once, as the end of a pipe that is for the other one.
bool may_wait_for(int descriptor, short events);

/// Before a call that may block on `descriptor`: its event, and the wait. False, with errno set, if the call has
/// failed.
bool prepare(int descriptor, DescriptorClass of, kernel::Operation operation, short events, bool may_block);

/// All that is sent and received, to whoever looks for races: what was sent happens before what follows its reception,
/// and whose it was, the system knows.
inline constexpr char all_descriptors = 0;

/// The call, and a look at who may go on by it.
template <class Call>
auto done(Call call) {
  if (kernel::sanitizer::present) kernel::sanitizer::release(&all_descriptors);
  const auto result = call();
  if (kernel::sanitizer::present) kernel::sanitizer::acquire(&all_descriptors);
  look_at_descriptors();
  handle_what_came_with_a_call();
  return result;
}

template <class Call>
auto receive(int descriptor, bool may_block, Call call) {
  const DescriptorClass of = class_of(descriptor);
  if (of == DescriptorClass::file) return at_cancellation_point(call);
  if (!prepare(descriptor, of, kernel::Operation::receive, POLLIN, may_block)) return static_cast<decltype(call())>(-1);
  const auto received = done(call);
  acknowledge(descriptor);
  return received;
}

template <class Call>
auto send_all_at_once(int descriptor, bool may_block, Call call) {
  const DescriptorClass of = class_of(descriptor);
  if (of == DescriptorClass::file) return at_cancellation_point(call);
  if (!prepare(descriptor, of, kernel::Operation::send, POLLOUT, may_block)) return static_cast<decltype(call())>(-1);
  return done(call);
}

/// A pipe or a stream that can take something may not be able to take all: piece by piece, as much as it takes.
/// `take(bytes, size)` gives it some without waiting; how much it took, or -1.
template <class Take>
std::ptrdiff_t write_all(int descriptor, DescriptorClass of, const char* bytes, std::size_t size, Take take) {
  std::size_t written = 0;
  do {
    if (!prepare(descriptor, of, kernel::Operation::send, POLLOUT, true)) break;
    const std::ptrdiff_t count = done([&] { return take(bytes + written, size - written); });
    if (count < 0 && errno == EAGAIN) continue;
    if (count < 0) break;
    written += static_cast<std::size_t>(count);
    if (written == size) return static_cast<std::ptrdiff_t>(written);
  } while (true);
  return written > 0 ? static_cast<std::ptrdiff_t>(written) : -1;
}

}  // namespace waitpoint::posix
