// SPDX-License-Identifier: BSD-3-Clause
//
// read(), write() and their vectored forms.
#include <limits.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/descriptors/signal_descriptors.hpp"
#include "fibers/posix/files/random_devices.hpp"
#include "fibers/posix/input_output/input_output.hpp"
#include "fibers/posix/input_output/sockets.hpp"
#include "fibers/posix/input_output/user_streams.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/randomness.hpp"
#include "fibers/posix/timers/timer_descriptors.hpp"

using namespace waitpoint;
using namespace waitpoint::posix;

namespace {

// Also before main(), where no descriptor has a class: constructors of libraries draw their seeds.
bool reads_random(int descriptor) {
  const bool may = is_simulated() ? class_of(descriptor) == DescriptorClass::other : !has_host;
  return may && gives_random(descriptor);
}

ssize_t as_of_library(long result) {
  if (result >= 0) return result;
  errno = static_cast<int>(-result);
  return -1;
}

// With events and waits in virtual time.
ssize_t write_in_time(int descriptor, const void* bytes, std::size_t size) {
  const DescriptorClass of = class_of(descriptor);
  // The underlying eventfd is not visible to the program.
  if (of == DescriptorClass::other && (is_timer_descriptor(descriptor) || is_signal_descriptor(descriptor)))
    return fail(EINVAL);
  if (size > 0 && of == DescriptorClass::socket && is_stream(descriptor))
    return send_to_stream(descriptor, bytes, size, 0);
  if (size > 0 && of == DescriptorClass::pipe && may_wait_for(descriptor, POLLOUT))
    return write_all(descriptor, of, static_cast<const char*>(bytes), size, [&](const char* at, std::size_t left) {
      return as_of_library(write_at_once(descriptor, at, left));
    });
  return send_all_at_once(descriptor, true, [&] { return WAITPOINT_NEXT(write)(descriptor, bytes, size); });
}

}  // namespace

WAITPOINT_INTERPOSED ssize_t read(int descriptor, void* bytes, std::size_t size) {
  if (reads_random(descriptor)) {
    fill_with_random(bytes, size);
    return static_cast<ssize_t>(size);
  }
  if (is_simulated()) bring_up_to_date(descriptor);
  if (is_simulated() && is_signal_descriptor(descriptor))
    return receive(descriptor, true, [&] { return read_signals(descriptor, bytes, size); });
  // A read of size zero does not wait.
  return receive(descriptor, size > 0, [&] { return as_of_library(read_at_once(descriptor, bytes, size)); });
}

WAITPOINT_INTERPOSED ssize_t readv(int descriptor, const iovec* pieces, int count) {
  if (reads_random(descriptor)) {
    ssize_t all = 0;
    for (int i = 0; i < count; ++i) all += read(descriptor, pieces[i].iov_base, pieces[i].iov_len);
    return all;
  }
  if (is_simulated()) bring_up_to_date(descriptor);
  const bool is_valid = count > 0 && count <= IOV_MAX;
  end_counting(descriptor);
  return receive(descriptor, is_valid, [&] { return WAITPOINT_NEXT(readv)(descriptor, pieces, count); });
}

WAITPOINT_INTERPOSED ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  if (size > 0 && is_user_stream(descriptor)) {
    pass_cancellation_point();
    const ssize_t written = write_to_user(descriptor, static_cast<const char*>(bytes), size);
    if (written == static_cast<ssize_t>(size) || (written < 0 && errno != EAGAIN)) return written;
    const std::size_t done = static_cast<std::size_t>(std::max<ssize_t>(written, 0));
    const ssize_t rest = write_in_time(descriptor, static_cast<const char*>(bytes) + done, size - done);
    return rest < 0 && done == 0 ? rest : static_cast<ssize_t>(done) + std::max<ssize_t>(rest, 0);
  }
  return write_in_time(descriptor, bytes, size);
}

WAITPOINT_INTERPOSED ssize_t writev(int descriptor, const iovec* pieces, int count) {
  const DescriptorClass of = class_of(descriptor);
  const bool in_pieces = of == DescriptorClass::pipe || (of == DescriptorClass::socket && is_stream(descriptor)) ||
                         is_user_stream(descriptor);
  if (!in_pieces || !blocks(descriptor) || count < 0 || count > IOV_MAX)
    return send_all_at_once(descriptor, true, [&] { return WAITPOINT_NEXT(writev)(descriptor, pieces, count); });
  if (count > 0 && !can_be_read(pieces)) return fail(EFAULT);
  ssize_t all = 0;
  for (int i = 0; i < count; ++i) {
    if (pieces[i].iov_len == 0) continue;
    const ssize_t written = write(descriptor, pieces[i].iov_base, pieces[i].iov_len);
    if (written < 0) return all > 0 ? all : -1;
    WAITPOINT_CHECK(static_cast<std::size_t>(written) <= pieces[i].iov_len, "more was written than there was");
    all += written;
    if (static_cast<std::size_t>(written) < pieces[i].iov_len) break;
  }
  return all;
}
