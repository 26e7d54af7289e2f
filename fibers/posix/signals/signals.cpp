// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/signals/signals.hpp"

#include <sys/resource.h>
#include <ucontext.h>
#include <unistd.h>

#include <cstdlib>

#include "core/error.hpp"
#include "fibers/kernel/run.hpp"
#include "fibers/kernel/waiting_calls.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/stack_switch.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/timer_firing.hpp"
#include "fibers/posix/program/waiting.hpp"

namespace waitpoint::posix {

void (*after_pending_changed)() = nullptr;
void (*answer_question)() = nullptr;

namespace {

void note_pending_changed() {
  if (after_pending_changed != nullptr) after_pending_changed();
}

bool wants(const Thread& thread, int signal) {
  return thread.task != nullptr && (!contains(thread.blocked, signal) || contains(thread.awaited, signal));
}

// The program's first thread that accepts it, as in Linux.
Thread* taker_of(const Program& program, int signal) {
  const kernel::Scheduler* const scheduler = program.robot != nullptr ? program.robot->scheduler : nullptr;
  for (kernel::Task* task = scheduler != nullptr ? kernel::first_task(*scheduler) : nullptr; task != nullptr;
       task = task->next)
    if (is_thread(*task) && thread_of(*task).program == &program && wants(thread_of(*task), signal))
      return &thread_of(*task);
  return nullptr;
}

void tell(Thread& thread) {
  WAITPOINT_CHECK(thread.task != nullptr, "a thread that has ended is notified of a signal");
  kernel::Task& task = *thread.task;
  if (task.state == kernel::TaskState::blocked && thread.in_wait) {
    thread.woken_early = true;
    thread.woken_by_timer = is_timer_firing;
    kernel::wake(*task.scheduler, task);
  } else {
    kernel::attend(task, kernel::attention::signal, true);
  }
}

void send_on(PendingSignal& signal, Program& program, Thread* to) {
  WAITPOINT_CHECK(to == nullptr || to->program == &program, "a signal is sent to a thread of another program");
  const int number = signal.information.si_signo;
  WAITPOINT_CHECK(is_signal(number), "a signal without a number is sent");
  // Stop signals and SIGCONT cancel each other.
  const SignalSet opposite = number == SIGCONT ? stopping : contains(stopping, number) ? only(SIGCONT) : 0;
  if (opposite != 0) {
    program.signals.pending.drop(opposite);
    if (to != nullptr) to->pending.drop(opposite);
  }
  Thread* const taker = to != nullptr ? to : taker_of(program, number);
  // An ignored signal is discarded unless it is blocked, since its action may still change.
  const bool is_kept = taker == nullptr || contains(taker->blocked, number) || !program.signals.is_discarded(number);
  PendingSignals& pending = to != nullptr ? to->pending : program.signals.pending;
  if (!is_kept) {
    if (signal.taken != nullptr)
      signal.taken(signal);
    else
      std::free(&signal);
    return;
  }
  if (!pending.add(signal)) return;
  if (taker != nullptr && wants(*taker, number)) tell(*taker);
  note_pending_changed();
}

/// A call of a handler.
struct Call {
  const struct sigaction* action;
  siginfo_t* information;
  ucontext_t* context;
};

void call_handler(void* argument) {
  const Call& call = *static_cast<Call*>(argument);
  const int signal = call.information->si_signo;
  if ((call.action->sa_flags & SA_SIGINFO) != 0)
    call.action->sa_sigaction(signal, call.information, call.context);
  else
    call.action->sa_handler(signal);
}

bool is_on(const stack_t& stack, const void* address) {
  const auto* const low = static_cast<const char*>(stack.ss_sp);
  return address >= low && address < low + stack.ss_size;
}

void run_handler(Thread& thread, const struct sigaction& action, siginfo_t& information, ucontext_t& context) {
  Call call{&action, &information, &context};
  if ((action.sa_flags & SA_ONSTACK) != 0 && (thread.alternate.ss_flags & SS_DISABLE) == 0 &&
      !is_on(thread.alternate, &call))
    call_on(thread.alternate.ss_sp, thread.alternate.ss_size, call_handler, &call);
  else
    call_handler(&call);
}

// In the order of Linux, which stacks the frames of all deliverable signals: the handler of the last one runs first.
void handle_all(Thread& thread, Handled& handled) {
  siginfo_t information;
  while (const int signal = take_pending(~thread.blocked, information)) {
    struct sigaction& known = thread.program->signals.actions[signal];
    if (thread.program->signals.is_discarded(signal)) continue;
    if ((known.sa_flags & SA_SIGINFO) == 0 && known.sa_handler == SIG_DFL) {
      do_default(signal);
      continue;
    }
    const struct sigaction action = known;
    if ((action.sa_flags & static_cast<int>(SA_RESETHAND)) != 0) {
      known.sa_handler = SIG_DFL;
      known.sa_flags &= ~SA_SIGINFO;
      install(signal);
    }
    ucontext_t context{};
    context.uc_sigmask = to_sigset(thread.has_temporary_mask ? thread.blocked_after : thread.blocked);
    context.uc_stack = thread.alternate;
    thread.has_temporary_mask = false;
    SignalSet blocked = thread.blocked | to_set(action.sa_mask);
    if ((action.sa_flags & SA_NODEFER) == 0) blocked |= only(signal);
    thread.blocked = blocked & ~unblockable;
    handled.any = true;
    handled.restart = handled.restart && (action.sa_flags & SA_RESTART) != 0;
    handle_all(thread, handled);
    run_handler(thread, action, information, context);
    set_blocked(to_set(context.uc_sigmask));
  }
}

}  // namespace

siginfo_t from_here(int signal, int code) {
  siginfo_t information{};
  information.si_signo = signal;
  information.si_code = code;
  information.si_pid = getpid();
  information.si_uid = getuid();
  return information;
}

bool send(const siginfo_t& information, Program& program, Thread* to) {
  auto* const memory = static_cast<PendingSignal*>(std::malloc(sizeof(PendingSignal)));
  if (memory == nullptr) return false;
  auto* const signal = new (memory) PendingSignal();
  signal->information = information;
  send_on(*signal, program, to);
  return true;
}

void send(PendingSignal& signal, Program& program, Thread* to) {
  WAITPOINT_CHECK(signal.taken != nullptr, "a signal owned by its sender would be freed when it is taken");
  send_on(signal, program, to);
}

Handled handle_signals() {
  Thread& thread = this_thread();
  thread.delivery_due = false;
  if (thread.cancel_at_once && is_to_leave(thread)) pthread_exit(PTHREAD_CANCELED);
  Handled handled;
  if (deliverable(thread) == 0) return handled;
  // Handlers may wait, too.
  const bool in_wait = thread.in_wait, in_point = thread.in_cancellation_point;
  const SignalSet awaited = thread.awaited;
  thread.in_wait = thread.in_cancellation_point = false;
  thread.awaited = 0;
  handle_all(thread, handled);
  thread.in_wait = in_wait;
  thread.in_cancellation_point = in_point;
  thread.awaited = awaited;
  return handled;
}

void handle_what_came_with_a_call() {
  if (!has_come_from_outside()) return;
  const ErrorNumberKept kept;
  if (is_simulated() && take_in_signals_from_outside()) handle_signals();
}

bool is_interrupted(Restart restart) {
  const Handled handled = handle_signals();
  return handled.any && !(handled.restart && restart == Restart::if_asked);
}

int take_pending(SignalSet set, siginfo_t& information) {
  Thread& thread = this_thread();
  // The least number; the thread's own signal first if both have it.
  PendingSignals& of_all = thread.program->signals.pending;
  const SignalSet own = thread.pending.set() & set, all = of_all.set() & set;
  const bool from_all = own == 0 || (all != 0 && __builtin_ctzll(all) < __builtin_ctzll(own));
  const int signal = (from_all ? of_all : thread.pending).take(set, information);
  if (signal != 0) note_pending_changed();
  return signal;
}

void find_takers(Program& program) {
  SignalSet left = program.signals.pending.set();
  while (left != 0) {
    const int signal = __builtin_ctzll(left) + 1;
    left &= left - 1;
    if (Thread* const taker = taker_of(program, signal); taker != nullptr) tell(*taker);
  }
}

void set_blocked(SignalSet blocked) {
  Thread& thread = this_thread();
  blocked &= ~unblockable;
  const SignalSet more = blocked & ~thread.blocked;
  thread.blocked = blocked;
  ProgramSignals& signals = thread.program->signals;
  for (SignalSet fresh = more & ~signals.ever_blocked; fresh != 0; fresh &= fresh - 1) {
    const int signal = __builtin_ctzll(fresh) + 1;
    signals.ever_blocked |= only(signal);
    install(signal);
  }
  if ((more & signals.pending.set()) != 0) find_takers(*thread.program);
}

void drop_signals(Thread& thread) {
  WAITPOINT_CHECK(thread.ended, "the signals of a thread are dropped before its end");
  thread.pending.drop(~SignalSet{0});
  thread.awaited = 0;
  find_takers(*thread.program);
}

void forget_pending_signals() {
  program_now().signals.pending.drop(~SignalSet{0});
  if (is_simulated()) this_thread().pending.drop(~SignalSet{0});
}

// At a waitpoint of a thread with attention::signal set. If it waits, its call runs the handlers.
void deliver_signals(kernel::Task& task) {
  WAITPOINT_CHECK(&task == kernel::running && is_thread(task), "signals are delivered in another task than their own");
  Thread& thread = thread_of(task);
  if (thread.in_wait) {
    thread.delivery_due = true;
    return;
  }
  const OutOfKernel outside;
  handle_signals();
}

Wait wait_on(kernel::Object& object, Time deadline) {
  kernel::Task& task = *kernel::running;
  Thread& thread = thread_of(task);
  if (has_come_from_outside()) take_in_signals_from_outside();
  if ((deliverable(thread) | (pending_for(thread) & thread.awaited)) != 0) return Wait::interrupted;
  WAITPOINT_CHECK(!thread.in_wait, "a thread begins to wait within a wait");
  thread.woken_early = thread.delivery_due = false;
  thread.in_wait = true;
  const bool woken = block(object, deadline);
  WAITPOINT_CHECK(thread.in_wait, "a wait was ended by code within it");
  thread.in_wait = false;
  if (thread.woken_early) return Wait::interrupted;
  if (thread.delivery_due) kernel::attend(task, kernel::attention::signal, true);
  return woken ? Wait::came : Wait::timed_out;
}

}  // namespace waitpoint::posix
