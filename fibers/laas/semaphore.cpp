// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/laas/semaphore.hpp"

#include "fibers/kernel/waiting_calls.hpp"

#include <cerrno>
#include <limits>

namespace waitpoint::laas {

using kernel::Operation;

void Semaphore::create(Kind kind, int initial) {
  kernel::enter(object_);
  kind_ = kind;
  if (kind == Kind::mutex) object_.kind = "mutex semaphore";
  if (kind == Kind::count) object_.kind = "semaphore";
  count = initial;
  object_.owner = nullptr;
}

void Semaphore::destroy() {
  ++generation_;
  kind_ = Kind::none;
  object_.owner = nullptr;
  kernel::wake_all(*robot_.scheduler, object_);
}

TakeResult Semaphore::take(int ticks) {
  const std::uint32_t generation = generation_;
  if (!sync::before_blocking(ticks == NO_WAIT ? Operation::try_acquire : Operation::acquire, object_))
    return TakeResult::timed_out;
  if (generation != generation_) return TakeResult::deleted;
  if (kind_ == Kind::mutex && object_.owner == nullptr) {
    object_.owner = kernel::running;
    return TakeResult::taken;
  }
  if (kind_ == Kind::count && count > 0) {
    --count;
    return TakeResult::taken;
  }
  if (ticks == NO_WAIT) return TakeResult::timed_out;
  return wait(sync::state_of<Ticks>(robot_).deadline(ticks));
}

TakeResult Semaphore::wait(Time deadline) {
  const std::uint32_t generation = generation_;
  const bool woken = sync::block(object_, deadline);
  if (generation != generation_) return TakeResult::deleted;
  return woken ? TakeResult::taken : TakeResult::timed_out;
}

int Semaphore::give() {
  if (!sync::before_releasing(Operation::release, object_)) return 0;
  if (kind_ == Kind::mutex && object_.owner != kernel::running) return EPERM;
  if (kind_ == Kind::count && count == std::numeric_limits<int>::max()) return EOVERFLOW;
  hand_over();
  return 0;
}

void Semaphore::hand_over() {
  kernel::Scheduler& scheduler = *robot_.scheduler;
  if (kind_ == Kind::mutex)
    object_.owner = kernel::wake_first(scheduler, object_);
  else if (kernel::wake_one(scheduler, object_) == nullptr)
    ++count;
  else
    kernel::note_transfer();
}

void Semaphore::flush() {
  if (sync::before_releasing(Operation::notify_all, object_)) kernel::wake_all(*robot_.scheduler, object_);
}

void Semaphore::set(int units) {
  if (!sync::before_releasing(Operation::release, object_)) return;
  for (count = units; count > 0; --count)
    if (kernel::wake_one(*robot_.scheduler, object_) == nullptr) break;
}

}  // namespace waitpoint::laas
