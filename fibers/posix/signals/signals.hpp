// SPDX-License-Identifier: BSD-3-Clause
// Signals of the program: sent between its threads and by its timers without the system's doing, and delivered at
// waitpoints.
//
// Each thread has a mask of its own; to the system, nothing is blocked. What comes from outside (another process, the
// terminal) is caught, kept, and sent on at the next occasion. What the processor raises is handled on the spot.
//
//   send() -> pending, of the thread or the process -> a thread that does not block it is told: woken from a wait that
//   a signal ends, or asked to look at its next waitpoint -> handle_signals(), in that thread, calls handlers
//
// A wait that a signal ends comes back to its call with Wait::interrupted; the call puts in order what it has to (a
// handler may leave by siglongjmp()), lets handlers run, and then ends with EINTR or waits again.
#pragma once

#include "fibers/posix/program/pending_signals.hpp"
#include "fibers/posix/program/thread.hpp"

namespace waitpoint::posix {

struct SignalsOfProgram {
  struct sigaction actions[signals_end];  ///< by number
  PendingSignals pending;                 ///< sent to the process
  SignalSet blocked_before_main = 0;
  SignalSet ever_blocked = 0;  ///< by any thread: caught although nothing handles them
};
extern SignalsOfProgram signals_of_program;

/// How a wait ended.
enum class Wait : std::uint8_t { came, timed_out, interrupted };

/// Blocks the running thread on `object`. A signal that the thread does not block ends the wait.
Wait wait_on(kernel::Object& object, Time deadline);

/// What handlers were run.
struct Handled {
  bool any = false;
  bool restart = true;  ///< all of them by SA_RESTART
};

/// What `thread` would handle now.
inline SignalSet deliverable(const Thread& thread) {
  return (thread.pending.set() | signals_of_program.pending.set()) & ~thread.blocked;
}

/// What the kernel calls in a thread with signals to be handled.
void deliver_signals(kernel::Task& task);

/// Called after each change of what pends; null: not. Descriptors that signals are read from set it.
extern void (*after_pending_changed)();

/// Sends to a thread, or to the process where it is null; false if there is no memory to keep it.
bool send(const siginfo_t& information, Thread* to);
/// The same for a signal that somebody keeps, as timers do; it must not be pending.
void send(PendingSignal& signal, Thread* to);
/// A signal with what is told of one that the program sends itself.
siginfo_t from_here(int signal, int code);

/// Sends to the process, or to the thread with this gettid(), what the program itself says of a signal: an error
/// number.
int send_as_told(const siginfo_t& information);
int send_as_told(const siginfo_t& information, int id);

/// The running thread handles all that it does not block.
Handled handle_signals();
/// Whether a call whose wait was ended by a signal ends with EINTR; if not, it waits again.
enum class Restart : std::uint8_t { never, if_asked };
bool is_interrupted(Restart restart);

/// What pends for the running thread among `set`: taken; 0 if there is none.
int take_pending(SignalSet set, siginfo_t& information);
/// The mask of the running thread, from now on. Whoever else may take what it blocks is told.
void set_blocked(SignalSet blocked);
/// Tells somebody of each signal of the process that is pending.
void find_takers();
/// A thread ends: what pends for it is dropped.
void drop_signals(Thread& thread);
/// In a child: nothing pends.
void forget_pending_signals();

/// By which processes of a family ring for each other (family.hpp): nobody else sends it with that address.
inline constexpr int bell = SIGURG;
/// It is looked for from now on.
void install_bell();

/// What came from outside is sent on; whether there was anything.
bool take_in_signals_from_outside();
/// Whether something has come. Quick.
bool has_come_from_outside();
/// A signal that the system sends for what a call of the program's does (SIGIO, what mq_notify() asked for) comes
/// within the call, and its handler is to have run when that returns. `errno` stays.
void handle_what_came_with_a_call();
/// The system is told what to do with a signal: as `signals_of_program` says.
void install(int signal);
/// Ends or stops the process as the system does by default.
void do_default(int signal);

/// Before main(): what the program inherited.
void inherit_signals();

}  // namespace waitpoint::posix
