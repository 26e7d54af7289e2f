// SPDX-License-Identifier: BSD-3-Clause
// Common parts of reading, writing, sending and receiving: where the system would block the thread, it first waits for
// the descriptor, then makes the call.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>

#include "core/error.hpp"
#include "fibers/posix/descriptors/connections.hpp"
#include "fibers/posix/descriptors/descriptors.hpp"
#include "fibers/posix/links/loopback.hpp"
#include "fibers/posix/program/file_places.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::posix {

enum class DescriptorClass : std::uint8_t { file, pipe, socket, other };

/// Files are always ready, and their use is no event. Before main() all descriptors count as files.
DescriptorClass class_of(int descriptor);
/// True without O_NONBLOCK.
bool blocks(int descriptor);
/// The same for one direction: false if the descriptor is not open for it, so that the call fails at once.
bool may_wait_for(int descriptor, short events);

/// Before a call that may block on `descriptor`: its event and the wait. False, with errno set, if the call fails.
bool prepare(int descriptor, DescriptorClass of, kernel::Operation operation, short events, bool may_block);

/// The system's calls, on a descriptor that is ready, without one of the C library, which may be trapped: a negative
/// result is an error number. A pipe may take less than the whole.
long read_at_once(int descriptor, void* bytes, std::size_t size);
long write_at_once(int descriptor, const void* bytes, std::size_t size);

/// The object of all transfers for race detectors: a sending happens before the code after its reception. One object
/// for all, since only the system knows which descriptors are connected.
inline constexpr char all_descriptors = 0;

/// Makes the call, and wakes the threads that can continue after it.
template <class Call>
auto done(Call call, family::Changes changes = family::of_descriptors) {
  if (kernel::sanitizer::present) kernel::sanitizer::release(&all_descriptors);
  const auto result = call();
  if (kernel::sanitizer::present) kernel::sanitizer::acquire(&all_descriptors);
  look_at_descriptors(changes);
  handle_what_came_with_a_call();
  return result;
}

/// Of a file: changes its offset. The order of standard outputs is no outcome.
template <FunctionName name, class Call>
auto at_file(int descriptor, Call call) {
  pass_cancellation_point();
  if (descriptor != STDOUT_FILENO && descriptor != STDERR_FILENO)
    before_call<name>([&] { return changing_at(descriptor); });
  return call();
}

template <class Call>
auto receive(int descriptor, bool may_block, Call call) {
  const DescriptorClass of = class_of(descriptor);
  if (of == DescriptorClass::file) return at_file<"read">(descriptor, call);
  if (!prepare(descriptor, of, kernel::Operation::receive, POLLIN, may_block)) return static_cast<decltype(call())>(-1);
  const auto received = done(call, changes_at(descriptor, POLLIN));
  acknowledge(descriptor);
  return received;
}

template <class Call>
auto send_all_at_once(int descriptor, bool may_block, Call call) {
  const DescriptorClass of = class_of(descriptor);
  if (of == DescriptorClass::file) return at_file<"write">(descriptor, call);
  if (!prepare(descriptor, of, kernel::Operation::send, POLLOUT, may_block)) return static_cast<decltype(call())>(-1);
  return done(call, changes_at(descriptor, POLLOUT));
}

/// Writes in pieces, since a pipe or a stream that is ready may not have room for all. `take(bytes, size)` writes
/// without waiting and returns how much, or -1.
template <class Take>
std::ptrdiff_t write_all(int descriptor, DescriptorClass of, const char* bytes, std::size_t size, Take take) {
  std::size_t written = 0;
  do {
    if (!prepare(descriptor, of, kernel::Operation::send, POLLOUT, true)) break;
    const std::ptrdiff_t count =
        done([&] { return take(bytes + written, size - written); }, changes_at(descriptor, POLLOUT));
    if (count < 0 && errno == EAGAIN) continue;
    if (count < 0) break;
    WAITPOINT_CHECK(static_cast<std::size_t>(count) <= size - written, "more was written than there was");
    written += static_cast<std::size_t>(count);
    if (written == size) return static_cast<std::ptrdiff_t>(written);
  } while (true);
  return written > 0 ? static_cast<std::ptrdiff_t>(written) : -1;
}

}  // namespace waitpoint::posix
