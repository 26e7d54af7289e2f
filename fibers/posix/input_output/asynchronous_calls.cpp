// SPDX-License-Identifier: BSD-3-Clause
//
// The calls of asynchronous input and output.
#include <aio.h>
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <new>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/input_output/asynchronous.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/cancellation.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {
namespace {

int error_of(const aiocb& block) { return __atomic_load_n(&block.__error_code, __ATOMIC_ACQUIRE); }

/// True if any of the requests is done.
bool is_any_done(const aiocb* const* blocks, int count) {
  for (int i = 0; i < count; ++i)
    if (blocks[i] != nullptr && error_of(*blocks[i]) != EINPROGRESS) return true;
  return false;
}

bool are_all_done(aiocb* const* blocks, int count) {
  for (int i = 0; i < count; ++i)
    if (blocks[i] != nullptr && blocks[i]->aio_lio_opcode != LIO_NOP && error_of(*blocks[i]) == EINPROGRESS)
      return false;
  return true;
}

// Submits a request of a list; returns 0, or -1 if it was rejected.
int submit_one(aiocb& block, RequestBatch* batch) {
  if (block.aio_lio_opcode == LIO_READ) return submit(block, Request::read, batch);
  if (block.aio_lio_opcode == LIO_WRITE) return submit(block, Request::write, batch);
  block.__error_code = EINVAL;
  block.__return_value = -1;
  return fail(EINVAL);
}

// Waits until all are done or a signal handler has run.
int wait_for_all(aiocb* const* blocks, int count) {
  while (!are_all_done(blocks, count))
    if (wait_for_any_request(Time::max()) == Wait::interrupted && is_interrupted(Restart::if_asked)) return fail(EINTR);
  for (int i = 0; i < count; ++i)
    if (blocks[i] != nullptr && blocks[i]->aio_lio_opcode != LIO_NOP && error_of(*blocks[i]) != 0) return fail(EIO);
  return 0;
}

// The batch is counted down by each request, and freed with the last one.
int start_all(aiocb* const* blocks, int count, const sigevent* event) {
  void* const memory = std::malloc(sizeof(RequestBatch));
  if (memory == nullptr) return fail(EAGAIN);
  auto* const batch = new (memory) RequestBatch();
  batch->event.sigev_notify = SIGEV_NONE;
  if (event != nullptr) batch->event = *event;
  batch->left = 1;
  int result = 0;
  for (int i = 0; i < count; ++i) {
    if (blocks[i] == nullptr || blocks[i]->aio_lio_opcode == LIO_NOP) continue;
    ++batch->left;
    if (submit_one(*blocks[i], batch) == 0) continue;
    WAITPOINT_CHECK(batch->left > 1, "a rejected request was counted as done");
    --batch->left;
    result = fail(EIO);
  }
  WAITPOINT_CHECK(batch->left > 0, "a batch was freed while requests were added to it");
  if (--batch->left > 0) return result;
  const ErrorNumberKept kept;
  tell_by(batch->event);
  std::free(memory);
  return result;
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint;
using namespace waitpoint::posix;

// Under the C library's names: with 64-bit offsets, the header redirects the names without a size to the others.
static_assert(sizeof(aiocb) == sizeof(aiocb64) && offsetof(aiocb, aio_offset) == offsetof(aiocb64, aio_offset) &&
                  offsetof(aiocb, __error_code) == offsetof(aiocb64, __error_code),
              "both names of a call take the same record");
#define WAITPOINT_BOTH(result, name, arguments, ...)                                                           \
  extern "C" [[gnu::visibility("default")]] result waitpoint_##name arguments __VA_ARGS__ __asm__(#name "64"); \
  extern "C" [[gnu::visibility("default"),                                                                     \
               gnu::alias(#name "64")]] result waitpoint_##name##_32 arguments __VA_ARGS__ __asm__(#name);     \
  result waitpoint_##name arguments __VA_ARGS__

WAITPOINT_BOTH(int, aio_read, (aiocb * block), noexcept) {
  return is_simulated() ? submit(*block, Request::read, nullptr) : fail(ENOSYS);
}

WAITPOINT_BOTH(int, aio_write, (aiocb * block), noexcept) {
  return is_simulated() ? submit(*block, Request::write, nullptr) : fail(ENOSYS);
}

WAITPOINT_BOTH(int, aio_fsync, (int operation, aiocb* block), noexcept) {
  if (!is_simulated()) return fail(ENOSYS);
  if (operation != O_DSYNC && operation != O_SYNC) return fail(EINVAL);
  if (WAITPOINT_NEXT(fcntl)(block->aio_fildes, F_GETFL) < 0) return fail(EBADF);
  return submit(*block, operation == O_SYNC ? Request::sync : Request::sync_data, nullptr);
}

// It takes time, so that a polling loop ends.
WAITPOINT_BOTH(int, aio_error, (const aiocb* block), noexcept) {
  const int error = error_of(*block);
  if (error == EINPROGRESS && is_simulated()) sched_yield();
  return error;
}

WAITPOINT_BOTH(ssize_t, aio_return, (aiocb * block), noexcept) { return block->__return_value; }

WAITPOINT_BOTH(int, aio_suspend, (const aiocb* const* blocks, int count, const timespec* timeout), ) {
  if (!is_simulated()) return fail(ENOSYS);
  if (count < 0) return fail(EINVAL);
  const CancellationPoint point;
  pass(kernel::Operation::wait, nullptr);
  const Time deadline = timeout == nullptr ? Time::max() : later(kernel::local_time(*kernel::running), span(*timeout));
  bool any = false;
  for (int i = 0; i < count; ++i) any = any || blocks[i] != nullptr;
  while (any && !is_any_done(blocks, count)) {
    if (deadline <= kernel::running->local_time) return fail(EAGAIN);
    const Wait ended = point.was_cancelled() ? Wait::interrupted : wait_for_any_request(deadline);
    leave_if_cancelled();
    // As in the C library, by a futex.
    const Restart restart = timeout == nullptr ? Restart::if_asked : Restart::never;
    if (ended == Wait::interrupted && is_interrupted(restart)) return fail(EINTR);
  }
  return 0;
}

WAITPOINT_BOTH(int, aio_cancel, (int descriptor, aiocb* block), noexcept) {
  if (!is_simulated()) return fail(ENOSYS);
  if (WAITPOINT_NEXT(fcntl)(descriptor, F_GETFL) < 0) return fail(EBADF);
  if (block != nullptr && block->aio_fildes != descriptor) return fail(EINVAL);
  pass(kernel::Operation::modify, nullptr);
  return block != nullptr ? cancel_request(*block) : cancel_requests(descriptor);
}

WAITPOINT_BOTH(int, lio_listio, (int mode, aiocb* const* blocks, int count, sigevent* event), noexcept) {
  if (!is_simulated()) return fail(ENOSYS);
  if (mode != LIO_WAIT && mode != LIO_NOWAIT) return fail(EINVAL);
  for (int i = 0; i < count && mode == LIO_WAIT; ++i)
    if (blocks[i] != nullptr) blocks[i]->aio_sigevent.sigev_notify = SIGEV_NONE;
  const int started = start_all(blocks, count, mode == LIO_NOWAIT ? event : nullptr);
  return mode == LIO_NOWAIT ? started : wait_for_all(blocks, count);
}
