// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/kernel/fault_reports.hpp"

#include <sys/syscall.h>
#include <sys/uio.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <utility>

#include "core/doing.hpp"
#include "core/spin_lock.hpp"
#include "fibers/kernel/call_stack.hpp"
#include "fibers/kernel/death_text.hpp"
#include "fibers/kernel/process_end.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/signal_safe_text.hpp"
#include "fibers/switch/sanitizer.hpp"
#include "fibers/switch/stack_arena.hpp"

namespace waitpoint::kernel {
namespace {

// The process's. `lock` is held for the few system calls of installing and restoring the handlers.
SpinLock lock;
std::uint32_t installers = 0;  // the number of threads with reports
std::atomic<bool> are_installed = false;
struct sigaction previous[std::size(FaultReports::signals)];
std::atomic<PostMortem> post_mortem = nullptr, call_stack_writer = nullptr;
std::atomic<const char*> unfinished = nullptr;  // the replay line of an unfinished run
std::atomic<bool> is_reported = false;          // its death

// The thread's own.
constinit thread_local FaultReports* innermost = nullptr;
constinit thread_local ucontext_t* fault_context = nullptr;  // of the signal that is handled
// A bug and an overrun stack were reported before their SIGABRT.
constinit thread_local bool is_described = false;

// The task that overran its stack, or null. Usually the running one; but a task that overruns its stack while it hands
// over is no longer the running one.
const Task* overflowed(const Scheduler& scheduler, const char* address) {
  // A frame may be larger than the guard page, so the range below the stack is as large as the stack.
  if (running != nullptr) {
    const Stack& stack = running->fiber.stack;
    if (address < stack.low && address >= stack.low - bytes(stack.size)) return running;
  }
  for (const Task* task = first_task(scheduler); task != nullptr; task = task->next) {
    const Stack& stack = task->fiber.stack;
    if (StackArena::guards(stack, address) || !StackArena::intact(stack)) return task;
  }
  return nullptr;
}

bool is_readable(std::uint64_t address) {
  char byte = 0;
  const iovec to{&byte, 1}, from{reinterpret_cast<void*>(address), 1};
  return process_vm_readv(getpid(), &to, 1, &from, 1, 0) == 1;
}

// A call through a bad pointer: back to the address that it returns to, which is on top of the stack or in a register.
// The unwinder would read the code at the bad address.
void leave_bad_code(ucontext_t& context) {
#if defined(__x86_64__)
  greg_t* const registers = context.uc_mcontext.gregs;
  if (is_readable(static_cast<std::uint64_t>(registers[REG_RIP]))) return;
  registers[REG_RIP] = *reinterpret_cast<greg_t*>(registers[REG_RSP]);
  registers[REG_RSP] += sizeof(greg_t);
#elif defined(__aarch64__)
  constexpr int link = 30;
  if (!is_readable(context.uc_mcontext.pc)) context.uc_mcontext.pc = context.uc_mcontext.regs[link];
#endif
}

[[noreturn]] void act_in_copy(PostMortem function, const char* reason) {
  constexpr unsigned time_limit_s = 20;
  for (const int signal : FaultReports::signals) std::signal(signal, SIG_DFL);
  std::signal(SIGALRM, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  alarm(time_limit_s);
  if (fault_context != nullptr) leave_bad_code(*fault_context);
  function(reason);
  syscall(SYS_exit_group, 0);
  __builtin_unreachable();
}

// In a forked copy: its own death costs what it had to do, and no more.
void act(PostMortem function, const char* reason, const char* if_it_dies) {
  if (function == nullptr) return;
  const pid_t copy = _Fork();
  if (copy == 0) act_in_copy(function, reason);
  int status = 0;
  // The C library's function is noted as a task's wait, with the call stack, which may be unreadable.
  while (copy > 0 && syscall(SYS_wait4, copy, &status, 0, nullptr) < 0 && errno == EINTR) {
  }
  if (copy > 0 && status == 0) return;
  SignalSafeText text;
  text.add("  ").add(if_it_dies).add("\n").write();
}

// True in a thread that runs no tasks, while another does.
bool is_elsewhere() { return are_installed && innermost == nullptr && running == nullptr; }

// At exit(): a caller such as a CI would take its status for the run's.
void end_by_exit(int status, void*) {
  refuse_exit("exit()");
  const int settled = settle_exit_status(status);
  if (settled == status) return;
  std::fflush(nullptr);
  syscall(SYS_exit_group, settled);
}
// Its status is not known here.
void end_by_quick_exit() {
  constexpr int unknown = -1;
  refuse_exit("quick_exit()");
  if (const int settled = settle_exit_status(unknown); settled != unknown) syscall(SYS_exit_group, settled);
}

const char* to_text(bool is_elsewhere) {
  if (!is_elsewhere) return "\n";
  return Commit::has_begun() ? ", in a thread of the operating system, after the results of the run\n"
                             : ", in a thread of the operating system\n";
}

}  // namespace

void report_overflow(const Task& task) {
  const StackSize size = task.fiber.stack.size;
  SignalSafeText text;
  text.add("waitpoint: bug: a task ran over the end of its stack\n").write();
  is_described = true;
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

void set_call_stack_writer(PostMortem function) { call_stack_writer = function; }
void set_unfinished_run(const char* replay_line) { unfinished = replay_line; }
PostMortem set_post_mortem(PostMortem function) { return post_mortem.exchange(function); }

void report(const char* reason) {
  const bool elsewhere = is_elsewhere();
  if (!is_described) {
    SignalSafeText text;
    text.add("waitpoint: ").add(reason).add(to_text(elsewhere)).write();
    if (running != nullptr && !elsewhere) describe_run(*running);
  }
  if (running == nullptr || elsewhere) {
    SignalSafeText where;
    if (!elsewhere && Doing::present() != nullptr) where.add("  while ").add(Doing::present()).add("\n");
    if (const char* const replay = unfinished; replay != nullptr) where.add("  replay: ").add(replay).add("\n");
    where.write();
  }
  act(call_stack_writer, reason, "its call stack cannot be read");
}

void report_death(const char* reason) {
  begin_death();
  is_reported = true;
  report(reason);
  act(post_mortem, reason, "the outputs are lost");
}

bool in_reporting_process() {
  const bool is_own = innermost != nullptr ? innermost->process() == getpid() : is_process_of_tasks();
  return !is_reported && are_installed && is_own;
}

bool in_unfinished_run() { return in_reporting_process() && unfinished != nullptr; }

bool in_model_code() {
  return in_reporting_process() && !is_elsewhere() && (running != nullptr || Doing::present() != nullptr);
}

void refuse_exit(const char* function) {
  if (!in_model_code() && !in_unfinished_run()) return;
  std::fflush(nullptr);
  char reason[80];
  const char* const place = !in_model_code() && Commit::has_begun() ? "before the end of the process"
                            : !in_model_code()                      ? "before the end of the run"
                            : running != nullptr                    ? "in a task"
                                                                    : "in a module";
  std::snprintf(reason, sizeof reason, "%s is called %s", function, place);
  report_death(reason);
  syscall(SYS_exit_group, 1);
}

FaultReports::FaultReports(Scheduler* scheduler) : outer_(innermost), scheduler_(scheduler), process_(getpid()) {
  if (sanitizer::present) return;
  innermost = this;
  if (outer_ == nullptr) thread_.emplace();
  outermost().thread_->set_scheduler(scheduler);
  if (outer_ != nullptr) return;
  stack_.emplace();
  const std::lock_guard guard(lock);
  if (installers++ > 0) return;
  static bool is_registered = false;
  if (!std::exchange(is_registered, true)) {
    on_exit(end_by_exit, nullptr);
    at_quick_exit(end_by_quick_exit);
  }
  struct sigaction action {};
  action.sa_sigaction = handle;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_ONSTACK);
  for (std::size_t i = 0; i < std::size(signals); ++i) sigaction(signals[i], &action, &previous[i]);
  are_installed = true;
}

FaultReports::~FaultReports() {
  if (innermost != this) return;
  innermost = outer_;
  if (outer_ != nullptr) {
    outermost().thread_->set_scheduler(outer_->scheduler_);
    return;
  }
  {
    const std::lock_guard guard(lock);
    if (--installers == 0) {
      are_installed = false;
      for (std::size_t i = 0; i < std::size(signals); ++i) {
        struct sigaction present {};
        sigaction(signals[i], &previous[i], &present);
        if ((present.sa_flags & static_cast<int>(SA_SIGINFO)) == 0 || present.sa_sigaction != handle)
          sigaction(signals[i], &present, nullptr);
      }
    }
  }
}

FaultReports& FaultReports::outermost() {
  FaultReports* at = this;
  while (at->outer_ != nullptr) at = at->outer_;
  return *at;
}

void FaultReports::handle(int signal, siginfo_t* info, void* context) {
  // A signal that a process sends (si_code <= 0) has no address; abort() and raise() send their own.
  const bool is_fault = info->si_code > 0, is_own = is_fault || info->si_pid == getpid();
  if (are_installed && (is_own || unfinished != nullptr)) {
    const Scheduler* const scheduler = running != nullptr     ? running->scheduler
                                       : innermost != nullptr ? innermost->scheduler_
                                                              : nullptr;
    if (signal == SIGSEGV && is_fault && scheduler != nullptr)
      if (const Task* task = overflowed(*scheduler, static_cast<const char*>(info->si_addr))) report_overflow(*task);
    fault_context = static_cast<ucontext_t*>(context);
    if (running != nullptr || Doing::present() != nullptr || is_elsewhere() || unfinished != nullptr)
      report_death(death_text(*info));
    fault_context = nullptr;
  }
  pass_on(signal, info, context);
}

void FaultReports::pass_on(int signal, siginfo_t* info, void* context) {
  struct sigaction before {};
  for (std::size_t i = 0; i < std::size(signals); ++i)
    if (signals[i] == signal && are_installed) before = previous[i];
  if ((before.sa_flags & static_cast<int>(SA_SIGINFO)) != 0) return before.sa_sigaction(signal, info, context);
  if (before.sa_handler != SIG_DFL && before.sa_handler != SIG_IGN) return before.sa_handler(signal);
  begin_death();
  // The faulting instruction is executed again, with the default action; a signal sent by a process is raised again.
  sigaction(signal, &before, nullptr);
  if (info->si_code <= 0) raise(signal);
}

}  // namespace waitpoint::kernel

extern "C" void waitpoint_begin_death() { waitpoint::kernel::begin_death(); }

extern "C" void waitpoint_describe_run() {
  using namespace waitpoint::kernel;
  if (running == nullptr) return;
  is_described = true;
  describe_run(*running);
}
