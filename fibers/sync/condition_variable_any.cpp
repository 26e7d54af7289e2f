// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/sync/condition_variable_any.hpp"

#include "fibers/kernel/interruption.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/sync/report/misuse.hpp"

namespace waitpoint {

void condition_variable_any::notify_a_waiter() {
  std::uint32_t count = 0;
  for (const Waiter* waiter = first_; waiter != nullptr; waiter = waiter->next) ++count;
  if (count == 0) return;
  Waiter* chosen = first_;
  for (std::uint32_t i = kernel::chooser(*kernel::running->scheduler).waiter(*kernel::running, count); i > 0; --i)
    chosen = chosen->next;
  notify(*chosen);
}

void condition_variable_any::notify_all() {
  if (!sync::before_releasing(kernel::Operation::notify_all, object_) || !has_users()) return;
  while (first_ != nullptr) notify(*first_);
}

void condition_variable_any::notify(Waiter& waiter) {
  remove_waiter(waiter);
  waiter.notified = true;
  kernel::note_transfer();
  if (waiter.blocked) kernel::wake(*kernel::running->scheduler, *waiter.task);
}

bool condition_variable_any::enlist(Waiter& waiter) {
  if (!sync::before_blocking(kernel::Operation::wait, object_)) return false;
  waiter.task = kernel::running;
  if (waiter.stop != nullptr) waiter.stop->waiter = &waiter;
  if (object_.users++ == 0) first_ = last_ = nullptr;
  (first_ == nullptr ? first_ : last_->next) = &waiter;
  last_ = &waiter;
  return true;
}

void condition_variable_any::remove_waiter(Waiter& waiter) {
  Waiter* before = nullptr;
  for (Waiter* at = first_; at != &waiter; at = at->next) before = at;
  (before == nullptr ? first_ : before->next) = waiter.next;
  if (last_ == &waiter) last_ = before;
}

void condition_variable_any::leave(Waiter& waiter) {
  if (waiter.stop != nullptr) waiter.stop->waiter = nullptr;
  // After the end of the run, the list may be gone.
  if (kernel::is_unwinding(*kernel::running->scheduler)) return;
  if (!waiter.notified) remove_waiter(waiter);
  --object_.users;
}

bool condition_variable_any::sleep(Waiter& waiter, Time deadline) {
  const bool is_spurious =
      !waiter.notified && kernel::chooser(*kernel::running->scheduler).is_spurious(*kernel::running);
  if (!waiter.notified && !is_spurious) {
    waiter.blocked = true;
    sync::block(object_, deadline);
  }
  leave(waiter);
  return waiter.notified || is_spurious;
}

}  // namespace waitpoint
