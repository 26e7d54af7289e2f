// SPDX-License-Identifier: BSD-3-Clause
// Signals of the program: sent between its threads and by its timers without the system, and delivered at waitpoints.
//
// Each thread has its own mask; for the system, nothing is blocked. Signals from outside (another process, the
// terminal) are caught, queued, and sent on at the next occasion. Faults, raised by the processor, are handled at once.
//
//   send() -> pending, of the thread or the process -> notify a thread that does not block it: wake it from an
//   interruptible wait, or mark it for its next waitpoint -> handle_signals(), in that thread, calls the handlers
//
// An interrupted wait returns Wait::interrupted to its call, which cleans up (a handler may leave by siglongjmp()),
// runs the handlers, and then fails with EINTR or waits again.
#pragma once

#include "fibers/posix/program/pending_signals.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

/// How a wait ended.
enum class Wait : std::uint8_t { came, timed_out, interrupted };

/// Blocks the running thread on `object`, interruptible by the signals that it does not block.
Wait wait_on(kernel::Object& object, Time deadline);

/// The handlers that were run.
struct Handled {
  bool any = false;
  bool restart = true;  ///< all of them have SA_RESTART
};

/// The signals that are pending for `thread` or its program.
inline SignalSet pending_for(const Thread& thread) {
  return thread.pending.set() | thread.program->signals.pending.set();
}
/// Those that it does not block.
inline SignalSet deliverable(const Thread& thread) { return pending_for(thread) & ~thread.blocked; }

/// Called by the kernel in a thread with signals to be handled.
void deliver_signals(kernel::Task& task);

/// Called, unless null, after each change of the pending signals. Set by the descriptors from which signals are read.
extern void (*after_pending_changed)();

/// Sends to a program, or, unless it is null, to a thread of it; false without memory.
bool send(const siginfo_t& information, Program& program, Thread* to = nullptr);
/// The same for a signal owned by the caller, as by timers; it must not be pending.
void send(PendingSignal& signal, Program& program, Thread* to);
/// The information of a signal that the program sends to itself.
siginfo_t from_here(int signal, int code);

/// Sends to the running thread's program, or to its thread with this gettid(), a signal with information provided by
/// it; returns an error number or 0.
int send_as_told(const siginfo_t& information);
int send_as_told(const siginfo_t& information, int id);

/// The running thread handles all that it does not block.
Handled handle_signals();
/// Handles the signals that ended a call's wait. True: the call fails with EINTR; false: it waits again.
enum class Restart : std::uint8_t { never, if_asked };
bool is_interrupted(Restart restart);

/// Removes a signal of `set` pending for the running thread, and returns its number; 0 without one.
int take_pending(SignalSet set, siginfo_t& information);
/// Sets the mask of the running thread. Other threads are notified of the signals that it blocks now.
void set_blocked(SignalSet blocked);
/// Notifies a thread of each pending signal of the program.
void find_takers(Program& program);
/// Drops the pending signals of a thread that ends.
void drop_signals(Thread& thread);
/// In a child: no signal is pending.
void forget_pending_signals();

/// The signal of the layer's own timer, identified by its address.
inline constexpr int bell = SIGURG;
static_assert(contains(ignored_by_default, bell), "the bell harms no process that does not listen");
/// Catches it from now on.
void install_bell();

/// Asked by the process that watches the run: the bell with this value. It may interrupt any code. A process that has
/// no handler ignores it.
inline constexpr int question = 0x77703F;
bool is_question(const siginfo_t& information);
/// Answers it; null: nobody does.
extern void (*answer_question)();

/// Sends on the signals that came from outside; true if there were any.
bool take_in_signals_from_outside();
/// True if there are any. Fast.
bool has_come_from_outside();
/// A signal sent by the system because of a call of the program (SIGIO, a notification of mq_notify()) comes within the
/// call; its handler must have run when the call returns. Keeps `errno`.
void handle_what_came_with_a_call();
/// Installs the system's action for a signal, according to the program's.
void install(int signal);
/// Ends or stops the program by the default action.
void do_default(int signal);
/// The same for the process, whichever its programs.
void do_default_of_process(int signal);

/// Called, unless null, in the thread in which one of the signals `crashes` ends the process.
extern void (*on_crash)(int signal);

/// The signals that end the whole run by their default action. In `waitpoint exec` the process that watches the run
/// ends it, and reports the state of all threads first.
inline constexpr SignalSet ending = only(SIGINT) | only(SIGTERM) | only(SIGHUP);
/// Notes for that process which signals this one handles or blocks.
void note_caught_signals();

/// Before main(): reads the actions and the mask that the process inherited.
void inherit_signals();

}  // namespace waitpoint::posix
