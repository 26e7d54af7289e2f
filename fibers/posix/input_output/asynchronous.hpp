// SPDX-License-Identifier: BSD-3-Clause
// Asynchronous input and output. As in the C library, worker threads of the layer perform it: one for each descriptor
// with requests, one request at a time, the most urgent first.
//
//   submit() -> the queue of its descriptor -> its worker, which may wait -> done: noted in the program's aiocb, and
//   the program is notified
#pragma once

#include <aio.h>

#include "core/time.hpp"
#include "fibers/kernel/task.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {

/// The requests of one lio_listio(), with a notification when all are done.
struct RequestBatch {
  int left = 0;
  sigevent event{};
};

/// The operation on the descriptor of an aiocb.
enum class Request : std::uint8_t { read, write, sync, sync_data };

/// As aio_read() and similar calls; counts down `batch`, unless null, when the request is done.
int submit(aiocb& block, Request request, RequestBatch* batch);
/// Sends the notification that the program asked for.
void tell_by(const sigevent& event);
/// Waits until any request is done, as wait_on() does.
Wait wait_for_any_request(Time deadline);

/// As aio_cancel(), of one request, or of all of a descriptor.
int cancel_request(aiocb& block);
int cancel_requests(int descriptor);

/// In a child: there are no requests.
void forget_asynchronous_requests();
/// The task no longer exists: the requests of its queue, if it is a worker, are dropped.
void forget_worker(const kernel::Task& task);

}  // namespace waitpoint::posix
