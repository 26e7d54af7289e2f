// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/fault_reports.hpp"

#include <cstdlib>

#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/signal_safe_text.hpp"
#include "fibers/switch/sanitizer.hpp"

namespace waitpoint::kernel {
namespace {

// One stack suffices, since tasks run in one thread at a time. Large enough for the register state of any processor,
// and for a handler of the program's own that prints a call stack.
alignas(64) char handler_stack[64 * 1024];

const FaultReports* innermost = nullptr;

// The task that overran its stack, or null. Usually the running one; but a task that overruns its stack while it hands
// over is no longer the running one.
const Task* overflowed(const Scheduler& scheduler, const char* address) {
  // A frame may be larger than the guard page, so the range below the stack is as large as the stack.
  if (running != nullptr) {
    const Stack& stack = running->fiber.stack;
    if (address < stack.low && address >= stack.low - bytes(stack.size)) return running;
  }
  for (const Task* task = scheduler.first_task(); task != nullptr; task = task->next) {
    const Stack& stack = task->fiber.stack;
    if (StackArena::guards(stack, address) || !StackArena::intact(stack)) return task;
  }
  return nullptr;
}

}  // namespace

void report_overflow(const Task& task) {
  const StackSize size = task.fiber.stack.size;
  SignalSafeText text;
  text.add("waitpoint: bug: a task ran over the end of its stack\n").write();
  describe_run(task);
  SignalSafeText advice;
  advice.add("  its stack has ").add(std::uint64_t{bytes(size)} / 1024).add(" KiB; ");
  if (size >= StackSize::large) {
    advice.add("there is none larger: what is large belongs on the heap\n");
  } else {
    advice.add("a larger one: ").add(size == StackSize::small ? "StackSize::medium (64 KiB) or " : "");
    advice.add("StackSize::large (256 KiB) as `stack` of the thread_attributes it is made with\n");
  }
  advice.write();
  std::abort();
}

FaultReports::FaultReports(const Scheduler& scheduler) : scheduler_(scheduler), outer_(innermost) {
  if (sanitizer::present) return;
  // Already installed: the caller of many short runs installs it once for all of them.
  if (innermost != nullptr && &innermost->scheduler_ == &scheduler) return;
  innermost = this;
  stack_t stack{};
  stack.ss_sp = handler_stack;
  stack.ss_size = sizeof handler_stack;
  has_stack_ = sigaltstack(&stack, &previous_stack_) == 0;
  struct sigaction action {};
  action.sa_sigaction = handle;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK);
  sigaction(SIGSEGV, &action, &previous_);
}

FaultReports::~FaultReports() {
  if (innermost != this) return;
  struct sigaction present {};
  sigaction(SIGSEGV, &previous_, &present);
  if ((present.sa_flags & static_cast<int>(SA_SIGINFO)) == 0 || present.sa_sigaction != handle)
    sigaction(SIGSEGV, &present, nullptr);
  if (has_stack_) sigaltstack(&previous_stack_, nullptr);
  innermost = outer_;
}

void FaultReports::handle(int signal, siginfo_t* info, void* context) {
  // A signal sent by a process (si_code <= 0) has no address.
  if (innermost != nullptr && info->si_code > 0) {
    const Task* task = overflowed(innermost->scheduler_, static_cast<const char*>(info->si_addr));
    if (task != nullptr) report_overflow(*task);
    if (running != nullptr) {
      SignalSafeText text;
      text.add("waitpoint: a bad address is used at virtual time ").add(running->local_time).add(" s, in task ");
      text.add(running->name).add(" of ").add(running->robot->name).add("\n").write();
    }
  }
  pass_on(signal, info, context);
}

void FaultReports::pass_on(int signal, siginfo_t* info, void* context) {
  const struct sigaction previous = innermost->previous_;
  if ((previous.sa_flags & static_cast<int>(SA_SIGINFO)) != 0) return previous.sa_sigaction(signal, info, context);
  if (previous.sa_handler != SIG_DFL && previous.sa_handler != SIG_IGN) return previous.sa_handler(signal);
  // The faulting instruction is executed again, with the default action; a signal sent by a process is raised again.
  sigaction(signal, &previous, nullptr);
  if (info->si_code <= 0) raise(signal);
}

}  // namespace waitpoint::kernel
