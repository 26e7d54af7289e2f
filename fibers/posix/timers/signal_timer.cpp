// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/timers/signal_timer.hpp"

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/timers.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/program/timer_firing.hpp"
#include "fibers/posix/program/waiting.hpp"
#include "fibers/posix/time/clocks.hpp"

namespace waitpoint::posix {

constinit int SignalTimer::set_count_ = 0;

void SignalTimer::await() {
  if (due_ == Time::max()) return;
  ++set_count_;
  kernel::Scheduler& scheduler = *kernel::running->scheduler;
  kernel::enter(object_);
  const Time now = kernel::running->local_time;
  kernel::schedule(scheduler, node_.event, due_ > now ? due_ : now, object_);
}

void SignalTimer::start(Time due, Duration interval, Duration late) {
  WAITPOINT_CHECK(interval >= Duration() && late >= Duration(), "a timer is started with a negative time");
  stop();
  due_ = due;
  interval_ = interval;
  if (late > Duration() && interval > Duration()) {
    missed_ = static_cast<std::uint64_t>(late.ns() / interval.ns());
    const Time now = kernel::local_time(*kernel::running);
    // The latest expiration was less than an interval ago.
    due_ = Time::from_ns(now.ns() - late.ns() % interval.ns());
  }
  await();
}

void SignalTimer::start(const Duration& spent, Duration due, Duration interval) {
  WAITPOINT_CHECK(interval >= Duration(), "a timer is started with a negative interval");
  stop();
  interval_ = interval;
  set_processor_timer(processor_, spent, due);
}

void SignalTimer::stop() {
  if (node_.event.in_list()) kernel::cancel(*object_.robot->scheduler, node_.event);
  if (processor_.spent != nullptr) unset_processor_timer(processor_);
  WAITPOINT_CHECK(due_ == Time::max() || set_count_ > 0, "more timers are stopped than are set");
  if (due_ != Time::max()) --set_count_;
  due_ = Time::max();
  interval_ = Duration();
  missed_ = 0;
}

Duration SignalTimer::left() const {
  const Duration left = processor_.spent != nullptr ? processor_.due - *processor_.spent
                        : due_ != Time::max()       ? due_ - kernel::local_time(*kernel::running)
                                                    : Duration();
  return is_set() && left <= Duration() ? Duration::from_ns(1) : left;
}

void SignalTimer::expire(kernel::EventNode& node) {
  SignalTimer& timer = *reinterpret_cast<Node&>(node).timer;
  kernel::Scheduler& scheduler = *timer.object_.robot->scheduler;
  const Time now = kernel::global_time(scheduler);
  WAITPOINT_CHECK(&timer.node_.event == &node, "an event of another kind is taken for a timer's");
  WAITPOINT_CHECK(timer.due_ <= now && set_count_ > 0, "a timer expires that is not due or not set");
  std::uint64_t count = 1 + timer.missed_;
  timer.missed_ = 0;
  if (timer.interval_ > Duration()) {
    // All expirations up to now: a thread may have started it late.
    const std::int64_t more = (now - timer.due_).ns() / timer.interval_.ns();
    count += static_cast<std::uint64_t>(more);
    timer.due_ = later(timer.due_, Duration::from_ns((more + 1) * timer.interval_.ns()));
  } else {
    timer.due_ = Time::max();
  }
  if (timer.due_ != Time::max())
    kernel::schedule(scheduler, timer.node_.event, timer.due_, timer.object_);
  else
    --set_count_;
  const TimerFiring firing;
  timer.ring_(timer, count);
}

void SignalTimer::expire_by_processor(ProcessorTimer& processor, const Duration& spent) {
  SignalTimer& timer = *static_cast<Processor&>(processor).timer;
  WAITPOINT_CHECK(&timer.processor_ == &processor, "a timer on processor time belongs to another");
  WAITPOINT_CHECK(spent >= processor.due, "a timer on processor time expires before it is due");
  std::uint64_t count = 1;
  if (timer.interval_ > Duration()) {
    count += static_cast<std::uint64_t>((spent - processor.due).ns() / timer.interval_.ns());
    const auto passed = Duration::from_ns(static_cast<std::int64_t>(count) * timer.interval_.ns());
    set_processor_timer(processor, spent, processor.due + passed);
  }
  timer.ring_(timer, count);
}

}  // namespace waitpoint::posix
