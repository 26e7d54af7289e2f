// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/input_output/asynchronous.hpp"

#include <fcntl.h>
#include <limits.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <new>

#include "core/error.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/chain.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/input_output/input_output.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/timers/notification_threads.hpp"

namespace waitpoint::posix {
namespace {

constexpr int least_urgent = 20;  // AIO_PRIO_DELTA_MAX of the C library

struct Queued {
  aiocb* block;
  Request request;
  RequestBatch* batch;
  Queued* next;
};

/// The requests of a descriptor, and whether the first is in progress.
struct Queue {
  int descriptor;
  Queued* first;
  bool is_begun;
  const kernel::Task* worker;
  Queue* next;
};
Queue* queues = nullptr;

kernel::Object done_object{"asynchronous input and output"};

Queue* queue_of(int descriptor) {
  Queue* found = queues;
  while (found != nullptr && found->descriptor != descriptor) found = found->next;
  return found;
}

void remove(Queue& queue) {
  WAITPOINT_CHECK(queue_of(queue.descriptor) == &queue, "a descriptor has another queue of requests");
  posix::remove(queues, queue);
  std::free(&queue);
}

void finish(Queued* request, ssize_t result, int error) {
  request->block->__return_value = result;
  __atomic_store_n(&request->block->__error_code, error, __ATOMIC_RELEASE);
  const sigevent event = request->block->aio_sigevent;
  RequestBatch* const batch = request->batch;
  WAITPOINT_CHECK(batch == nullptr || batch->left > 0, "a batch has fewer requests than are done");
  std::free(request);
  kernel::wake_all(*kernel::running->scheduler, done_object);
  tell_by(event);
  if (batch == nullptr || --batch->left > 0) return;
  tell_by(batch->event);
  batch->~RequestBatch();
  std::free(batch);
}

ssize_t perform(const aiocb& block, Request request) {
  void* const bytes = const_cast<void*>(block.aio_buf);
  if (request == Request::sync) return fsync(block.aio_fildes);
  if (request == Request::sync_data) return fdatasync(block.aio_fildes);
  const bool reads = request == Request::read;
  if (class_of(block.aio_fildes) == DescriptorClass::file)
    return reads ? pread64(block.aio_fildes, bytes, block.aio_nbytes, block.aio_offset)
                 : pwrite64(block.aio_fildes, bytes, block.aio_nbytes, block.aio_offset);
  return reads ? read(block.aio_fildes, bytes, block.aio_nbytes) : write(block.aio_fildes, bytes, block.aio_nbytes);
}

void* work(void* argument) {
  auto& queue = *static_cast<Queue*>(argument);
  queue.worker = kernel::running;
  while (Queued* const request = queue.first) {
    queue.is_begun = true;
    const ssize_t result = perform(*request->block, request->request);
    const int error = result < 0 ? errno : 0;
    pass(kernel::Operation::release, &done_object);
    WAITPOINT_CHECK(queue.first == request && queue.is_begun, "another request has taken the place of one in progress");
    queue.first = request->next;
    queue.is_begun = false;
    finish(request, result, error);
  }
  remove(queue);
  return nullptr;
}

bool start_worker(Queue& queue) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  const bool is_made = start_blocking_signals(work, &queue, &attributes);
  pthread_attr_destroy(&attributes);
  return is_made;
}

bool synchronises(Request request) { return request == Request::sync || request == Request::sync_data; }

// After the requests of equal urgency; not before the one in progress. A synchronisation follows all that were made
// before.
void insert(Queue& queue, Queued& request) {
  if (synchronises(request.request)) return append(queue.first, request);
  Queued** link = &queue.first;
  WAITPOINT_CHECK(!queue.is_begun || queue.first != nullptr, "a request in progress is not in its queue");
  if (queue.is_begun && *link != nullptr) link = &(*link)->next;
  while (*link != nullptr && (*link)->block->aio_reqprio <= request.block->aio_reqprio) link = &(*link)->next;
  request.next = *link;
  *link = &request;
}

int refuse(aiocb& block, int error) {
  block.__error_code = error;
  block.__return_value = -1;
  return fail(error);
}

// Cancels the requests from `from` on.
void cancel_from(Queued** from) {
  Queued* each = *from;
  *from = nullptr;
  while (each != nullptr) {
    Queued* const next = each->next;
    finish(each, -1, ECANCELED);
    each = next;
  }
}

}  // namespace

int submit(aiocb& block, Request request, RequestBatch* batch) {
  pass(kernel::Operation::start, nullptr);
  if (synchronises(request)) block.aio_reqprio = 0;
  if (block.aio_reqprio < 0 || block.aio_reqprio > least_urgent) return refuse(block, EINVAL);
  if (Queue* const known = queue_of(block.aio_fildes); known != nullptr) {
    auto* const queued = static_cast<Queued*>(std::malloc(sizeof(Queued)));
    if (queued == nullptr) return refuse(block, EAGAIN);
    block.__error_code = EINPROGRESS;
    insert(*known, *new (queued) Queued{&block, request, batch, nullptr});
    return 0;
  }
  auto* const queue = static_cast<Queue*>(std::malloc(sizeof(Queue)));
  auto* const queued = static_cast<Queued*>(std::malloc(sizeof(Queued)));
  if (queue != nullptr && queued != nullptr) {
    kernel::enter(done_object);
    block.__error_code = EINPROGRESS;
    new (queued) Queued{&block, request, batch, nullptr};
    // Its worker begins at once: it cannot be cancelled any more.
    queues = new (queue) Queue{block.aio_fildes, queued, true, nullptr, queues};
    if (start_worker(*queue)) return 0;
    remove(*queue);
  } else {
    std::free(queue);
  }
  std::free(queued);
  return refuse(block, EAGAIN);
}

void tell_by(const sigevent& event) {
  if (event.sigev_notify == SIGEV_SIGNAL && is_signal(event.sigev_signo)) {
    siginfo_t information = from_here(event.sigev_signo, SI_ASYNCIO);
    information.si_value = event.sigev_value;
    send(information, this_program());
  } else if (event.sigev_notify == SIGEV_THREAD) {
    start_notification(event);
  }
}

Wait wait_for_any_request(Time deadline) {
  kernel::enter(done_object);
  return wait_on(done_object, deadline);
}

int cancel_request(aiocb& block) {
  Queue* const queue = queue_of(block.aio_fildes);
  for (Queued** link = queue != nullptr ? &queue->first : nullptr; link != nullptr && *link != nullptr;
       link = &(*link)->next) {
    if ((*link)->block != &block) continue;
    if (link == &queue->first && queue->is_begun) return AIO_NOTCANCELED;
    Queued* const request = *link;
    *link = request->next;
    finish(request, -1, ECANCELED);
    return AIO_CANCELED;
  }
  return AIO_ALLDONE;
}

int cancel_requests(int descriptor) {
  Queue* const queue = queue_of(descriptor);
  if (queue == nullptr || queue->first == nullptr) return AIO_ALLDONE;
  const bool is_begun = queue->is_begun;
  cancel_from(is_begun ? &queue->first->next : &queue->first);
  return is_begun ? AIO_NOTCANCELED : AIO_CANCELED;
}

void forget_asynchronous_requests() { queues = nullptr; }

void forget_worker(const kernel::Task& task) {
  for (Queue* queue = queues; queue != nullptr; queue = queue->next)
    if (queue->worker == &task) return remove(*queue);
}

}  // namespace waitpoint::posix
