// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/io/channel.hpp"

#include <algorithm>

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/kernel/waitpoint_calls.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::io {

void Channel::enter() {
  kernel::Scheduler& scheduler = *sync::running_task().scheduler;
  if (kernel::enter(receiving_)) {
    kernel::enter(sending_);
    scheduler_ = &scheduler;
    pollers_.clear();
    arrivals_ = 0;
    refresh();
  }
  WAITPOINT_REQUIRE(receiving_.robot == kernel::running->robot || kernel::is_unwinding(scheduler),
                    "a pipe, socket or mailbox is used by a task of another robot: robots talk through sockets and "
                    "mailbox senders");
}

void Channel::remove_poller(const kernel::Object& poller) {
  pollers_.erase(std::remove(pollers_.begin(), pollers_.end(), &poller), pollers_.end());
}

bool Channel::begin(kernel::Operation operation, kernel::Object& side) {
  enter();
  return sync::before_blocking(operation, side);
}

bool Channel::begin_release(kernel::Operation operation, kernel::Object& side) {
  if (kernel::running == nullptr || kernel::is_unwinding(*kernel::running->scheduler)) return false;
  enter();
  return sync::before_releasing(operation, side);
}

void Channel::wake_pollers() {
  for (kernel::Object* poller : pollers_) kernel::wake_first(*scheduler_, *poller);
}

void Channel::wake_one(kernel::Object& side) {
  if (scheduler_ == nullptr) return;  // not used yet
  // The data was made available after the preceding waitpoint.
  kernel::sanitizer::release(&side);
  kernel::note_transfer();
  kernel::wake_one(*scheduler_, side);
  wake_pollers();
}

// The choice of the waiter depends on this channel and its arrivals only: no unrelated robot can shift it.
void Channel::wake_one_for_arrival(kernel::Object& side) {
  if (scheduler_ == nullptr || kernel::is_unwinding(*scheduler_) || !kernel::has_entered(*scheduler_, side)) return;
  ++arrivals_;
  std::uint32_t count = 0;
  for (const kernel::Task* task = side.first_waiter; task != nullptr; task = task->next_waiter) ++count;
  if (count != 0) {
    kernel::Task* chosen = side.first_waiter;
    for (std::uint32_t i = kernel::chooser(*scheduler_).waiter(side, arrivals_, count); i > 0; --i)
      chosen = chosen->next_waiter;
    kernel::wake(*scheduler_, *chosen);
  }
  wake_pollers();
}

void Channel::wake_all(kernel::Object& side) {
  if (scheduler_ == nullptr) return;
  kernel::sanitizer::release(&side);
  kernel::note_transfer();
  kernel::wake_all(*scheduler_, side);
  wake_pollers();
}

void record_sent(std::string_view to, std::uint64_t what) {
  Digest name;
  name.add(to);
  kernel::record_output(name.value(), what);
}

}  // namespace waitpoint::io
