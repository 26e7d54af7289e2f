// SPDX-License-Identifier: BSD-3-Clause
#include "modules/genom/execution_task.hpp"

#include <algorithm>

#include "modules/genom/codel_end.hpp"

namespace waitpoint::genom {

ExecutionTask::ExecutionTask(ModuleData& module, std::string name, TaskOptions options, TaskComputing computing)
    : module_(module), options_(options), name_(std::move(name)), computing_(computing) {}

void ExecutionTask::signal() {
  if (periodic() || signalled_) return;
  signalled_ = true;
  event_.release();
}

void ExecutionTask::wake() {
  const std::lock_guard guard(module_.control_lock);
  signal();
}

// The task's own members, its posters, and the module's shared data.
void ExecutionTask::find_working_set(const AddModule& add_module) {
  constexpr std::size_t of_stack = 192;
  if (periodic())
    working_set_.add_between(this, &missed_deadlines_);
  else
    working_set_.add_between(this, &start_);
  add_module(working_set_);
  for (const OutputPosterBase* poster : posters_) poster->add_to(working_set_);
  working_set_.add_stack_below(of_stack);
  threads::this_thread::set_working_set(working_set_);
}

void ExecutionTask::run(const AddModule& add_module) {
  find_working_set(add_module);
  restore_after_codel([this] { return "the code before task " + name_ + " of module " + module_.name; });
  if (periodic()) timer_.emplace(Period::every(options_.period_ms), options_.delay_ms, "task period");
  {
    const BothLocks locks(module_);
    call_permanent(start_);
  }
  while (wake_up(wait())) threads::this_thread::yield();
  {
    const BothLocks locks(module_);
    call_permanent(end_);
    ended_ = true;
  }
  timer_.reset();
  module_.mailbox.event().release();
}

// Waits for the next wake-up. Returns the number of periods since the last one.
std::int64_t ExecutionTask::wait() {
  if (!periodic()) {
    if (wait_)
      wait_();
    else
      event_.acquire();
    return 1;
  }
  const Time done = threads::now();
  const std::int64_t periods = timer_->wait();
  // The deadline is the tick after the wake-up: the earliest of the `periods` ticks since.
  const Time deadline = timer_->due() - (periods - 1) * options_.period_ms;
  if (periods > 0 && deadline < done) {
    ++missed_deadlines_;
    greatest_lateness_ = std::max(greatest_lateness_, done - deadline);
  }
  return periods;
}

// False when the module is ending.
bool ExecutionTask::wake_up(std::int64_t periods) {
  const BothLocks locks(module_);
  signalled_ = false;
  missed_periods_ += periods - 1;
  if (module_.ending) return false;
  if (suspended_) return true;
  call_permanent(permanent_);
  if (suspended_) return true;
  bool state_changed = false;
  for (Activity& activity : module_.activities.used_of(*this)) state_changed |= step(activity);
  call_permanent(second_permanent_);
  for (OutputPosterBase* poster : posters_) {
    poster->update();
    poster->give();
  }
  if (state_changed) module_.mailbox.event().release();
  return true;
}

void ExecutionTask::call_permanent(const std::function<void()>& codel) {
  if (codel == nullptr) return;
  threads::this_thread::set_work("a permanent codel", name_.c_str());
  codel();
  end_codel(module_, "a permanent codel", name_);
  after_codel(options_.cost_us);
}

void ExecutionTask::after_codel(Duration cost) {
  threads::compute(cost);
  for (OutputPosterBase* poster : posters_) poster->give();
}

// Advances an activity by one codel; true if its state changed.
bool ExecutionTask::step(Activity& a) {
  if (a.state == State::init || a.state == State::ether || a.state == State::zombie) return false;
  const State before = a.state;
  if (a.interrupt) {
    a.interrupt = false;
    a.interrupted = true;
    a.state = State::inter;
  } else if (a.state == State::sleep) {
    a.state = State::exec;
  }
  std::optional<State> next;
  // States without a codel are passed at once.
  threads::this_thread::set_work(codel_name(a.state), a.type->name.c_str());
  while (!(next = a.type->codel(a.state, a))) {
    a.state = default_after(a.state);
    if (a.state == State::ether || a.state == State::zombie) break;
    threads::this_thread::set_work(codel_name(a.state), a.type->name.c_str());
  }
  end_codel(module_, codel_name(a.state), a.type->name);
  if (!next) return true;
  const State called = a.state;
  after_codel(a.type->cost);
  if (!allowed(called, *next)) {
    a.report = module_.report(StandardReport::forbidden_activity_transition);
    a.state = State::ether;
    suspended_ = true;
    return true;
  }
  a.state = *next;
  const bool goes_on = a.state != State::ether && a.state != State::zombie && a.state != State::sleep;
  if (goes_on) signal();
  return a.state != before;
}

}  // namespace waitpoint::genom
