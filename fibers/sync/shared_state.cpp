// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/shared_state.hpp"

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/sync/thread.hpp"

namespace waitpoint::sync {

void SharedState::wait() {
  before_blocking(kernel::Operation::wait, object_);
  if (deferred_ != nullptr) {
    const std::function<void()> run = std::exchange(deferred_, nullptr);
    own();
    run();
  }
  while (!ready_)
    if (!block(object_)) throw Unwind();  // in a destructor: there is no result
}

future_status SharedState::wait_before(Time deadline) {
  before_blocking(kernel::Operation::wait, object_);
  if (deferred_ != nullptr) return future_status::deferred;
  while (!ready_)
    if (deadline <= now() || !block(object_, deadline)) return ready_ ? future_status::ready : future_status::timeout;
  return future_status::ready;
}

void SharedState::own() {
  enter_run(object_);
  object_.owner = kernel::running;
}

void SharedState::retrieve() {
  if (retrieved_) throw future_error(future_errc::future_already_retrieved);
  retrieved_ = true;
}

bool SharedState::claim() {
  if (!before_releasing(kernel::Operation::make_ready, object_)) return false;
  check_not_stored();
  return true;
}

void SharedState::fail(std::exception_ptr failure, Ready when) {
  if (!claim()) return;
  failure_ = std::move(failure);
  store(when);
}

void SharedState::break_promise() {
  if (stored_ || kernel::running == nullptr || kernel::is_unwinding(*kernel::running->scheduler)) return;
  fail(std::make_exception_ptr(future_error(future_errc::broken_promise)));
}

void SharedState::store(Ready when) {
  stored_ = true;
  if (when == Ready::now) return publish();
  ThreadState* thread = thread_of(running_task());
  WAITPOINT_REQUIRE(thread != nullptr, "a result is to be made ready at the exit of a task that is not a thread");
  thread->at_end.push_back([self = shared_from_this()] {
    if (before_releasing(kernel::Operation::make_ready, self->object_)) self->publish();
  });
}

void SharedState::publish() {
  ready_ = true;
  object_.owner = nullptr;
  // The result was stored after the preceding waitpoint.
  kernel::sanitizer::release(&object_);
  kernel::wake_all(*kernel::running->scheduler, object_);
}

}  // namespace waitpoint::sync
