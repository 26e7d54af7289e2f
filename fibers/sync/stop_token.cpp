// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/stop_token.hpp"

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/waiting_calls.hpp"

namespace waitpoint::sync {

void StopState::refresh() {
  if (!enter_run(object_)) return;
  requested_ = false;
  first_ = last_ = called_ = nullptr;
}

bool StopState::requested() {
  refresh();
  before_blocking(kernel::Operation::stop_requested, object_);
  return requested_;
}

bool StopState::request() {
  refresh();
  if (!before_releasing(kernel::Operation::request_stop, object_) || requested_) return false;
  requested_ = true;
  while (first_ != nullptr) call(*first_);
  return true;
}

void StopState::call(StopCallback& callback) {
  // A task that destroys the callback meanwhile waits for the call's end. The callback may be destroyed afterwards.
  struct Called {
    Called(StopState& of, StopCallback& callback) : state(of) {
      state.unlink(callback);
      state.called_ = &callback;
      state.object_.owner = kernel::running;
    }
    ~Called() {
      state.called_ = nullptr;
      state.object_.owner = nullptr;
    }
    StopState& state;
  };
  {
    const Called called(*this, callback);
    callback.invoke(callback);
    before_releasing(kernel::Operation::release, object_);
  }
  kernel::wake_all(*kernel::running->scheduler, object_);
}

bool StopState::add(StopCallback& callback) {
  refresh();
  if (!before_blocking(kernel::Operation::add_callback, object_)) return true;  // the run is over: no calls
  if (requested_) return false;
  callback.epoch = object_.epoch;
  callback.previous = last_;
  (last_ == nullptr ? first_ : last_->next) = &callback;
  last_ = &callback;
  return true;
}

void StopState::unlink(StopCallback& callback) {
  (callback.previous == nullptr ? first_ : callback.previous->next) = callback.next;
  (callback.next == nullptr ? last_ : callback.next->previous) = callback.previous;
  callback.next = callback.previous = nullptr;
  callback.epoch = 0;
}

void StopState::remove(StopCallback& callback) {
  if (kernel::running != nullptr) {
    refresh();
    before_releasing(kernel::Operation::remove_callback, object_);
  }
  if (callback.epoch != 0 && callback.epoch == object_.epoch) return unlink(callback);
  if (kernel::running == nullptr || called_ != &callback) return;
  if (object_.owner == kernel::running) {
    called_ = nullptr;  // the callback destroys itself
    return;
  }
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  while (called_ == &callback)
    // The callback is still running: returning would destroy it during its call.
    if (kernel::block(scheduler, object_, Time::max()) == kernel::Wake::unwinding) kernel::abandon();
}

}  // namespace waitpoint::sync
