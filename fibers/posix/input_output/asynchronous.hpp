// SPDX-License-Identifier: BSD-3-Clause
// Asynchronous input and output. As in the C library, threads of the layer's own do what is asked for: one for each
// descriptor with anything to be done, one request after the other, the more urgent first.
//
//   submit() -> the queue of its descriptor -> its worker, which may wait -> done: the program's aiocb says so, and it
//   is told of
#pragma once

#include <aio.h>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

/// Requests of one lio_listio(), which is told of when all are done.
struct RequestBatch {
  int left = 0;
  sigevent event{};
};

/// What is asked for of `block`'s descriptor.
enum class Request : std::uint8_t { read, write, sync, sync_data };

/// As aio_read() and its kin; `batch` is counted down when it is done, if there is one.
int submit(aiocb& block, Request request, RequestBatch* batch);
/// Tells of what is done, as a program has asked for it.
void tell_by(const sigevent& event);
/// Waits until a request, whichever, is done, as wait_on() does.
Wait wait_for_any_request(Time deadline);

/// As aio_cancel(), of one request, or of all of a descriptor.
int cancel_request(aiocb& block);
int cancel_requests(int descriptor);

/// In a child: nothing is being done.
void forget_asynchronous_requests();
/// The task is not there any more: nobody does what it was to do.
void forget_worker(const kernel::Task& task);

}  // namespace waitpoint::posix
