// SPDX-License-Identifier: BSD-3-Clause
//
// The layer's own handler of signals, which is installed in the system in place of the program's: it keeps signals from
// outside until a thread can handle them.
#include <sys/syscall.h>
#include <time.h>
#include <ucontext.h>
#include <unistd.h>

#include "core/error.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/real_waits.hpp"
#include "fibers/posix/family/system_processes.hpp"
#include "fibers/posix/family/turn.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signal_calls/computing.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/timers/notification_threads.hpp"
#include "fibers/posix/traps/access_breakpoints.hpp"
#include "fibers/posix/traps/library_calls.hpp"
#include "fibers/posix/traps/library_range.hpp"
#include "fibers/posix/traps/library_return.hpp"
#include "fibers/posix/traps/processor_counter.hpp"
#include "fibers/posix/traps/processor_features.hpp"
#include "fibers/posix/traps/raw_calls.hpp"
#include "fibers/posix/traps/signal_frame.hpp"

extern "C" void* _dl_allocate_tls(void*);  // of the dynamic linker

namespace waitpoint::posix {

std::atomic<bool> waits_really = false;

namespace {

// Code in which no handler may be run: this library, the C library, the dynamic linker.
LibraryRange guarded[3];
const LibraryRange& c_library = guarded[1];

bool has_bell = false;

// Signals that have arrived and were not sent on yet: a ring buffer. It is written by a handler, which another may
// interrupt while it runs a handler of the program.
constexpr unsigned kept_max = 1024, held_back_from = kept_max - 16;
static_assert((kept_max & (kept_max - 1)) == 0 && held_back_from < kept_max, "the counters of places wrap");
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<unsigned>::is_always_lock_free,
              "handlers of signals use them");
struct Kept {
  std::atomic<bool> is_there;
  siginfo_t information;
};
Kept kept[kept_max];
std::atomic<unsigned> next_kept = 0, next_taken = 0;

// Blocked by the system while the layer's handler runs: else queued signals would nest, each in the one before.
constexpr SignalSet one_by_one = ~(faults | unblockable);
// Until the kept signals are sent on, the system keeps further ones.
std::atomic<bool> is_held_back = false;

void let_come() {
  const sigset_t set = to_sigset(one_by_one);
  WAITPOINT_NEXT(pthread_sigmask)(SIG_UNBLOCK, &set, nullptr);
}

// Blocks signals in the context that the layer's handler returns to.
void hold_back(ucontext_t& interrupted) {
  is_held_back.store(true);
  SignalSet blocked = 0;
  std::memcpy(&blocked, &interrupted.uc_sigmask, sizeof blocked);  // the system's mask is one word
  blocked |= one_by_one & ~only(bell);
  std::memcpy(&interrupted.uc_sigmask, &blocked, sizeof blocked);
}

void keep(const siginfo_t& information) {
  const unsigned at = next_kept.fetch_add(1);
  Kept& place = kept[at % kept_max];
  if (place.is_there.load()) return;  // the buffer is full: dropped, as by the system
  place.information = information;
  place.is_there.store(true);
}

// The system's notice of an end that the family has noted, or of a process that has just executed another program.
bool is_noted_in_family(const siginfo_t& information) {
  if (information.si_signo != SIGCHLD || information.si_code <= 0 || family::own == nullptr) return false;
  const family::Process* const child = family::find_in_system(information.si_pid);
  return child == nullptr || !child->is_native;
}

// Its default action is to end the run: that is done by the process that watches it.
bool ends_run(int signal) {
  return contains(ending, signal) && record != nullptr && record->settings.reports_ending &&
         program_now().signals.has_default(signal);
}

// Of several processes a signal sent to one ends that one alone, unless it is the first; the terminal's reach all.
bool pass_to_watcher(const siginfo_t& information) {
  if (!ends_run(information.si_signo) || information.si_pid == record->file.watcher) return false;
  const bool is_of_family = information.si_code <= 0 && family::find_in_system(information.si_pid) != nullptr;
  const bool is_for_all = information.si_code > 0 || family::own == nullptr || family::is_first();
  if (is_of_family || !is_for_all) return false;
  WAITPOINT_NEXT(syscall)(SYS_kill, record->file.watcher, information.si_signo);
  return true;
}

bool is_of_program(std::uintptr_t at) {
  bool is_guarded = false;
  for (const LibraryRange& range : guarded) is_guarded = is_guarded || range.contains(at);
  return !is_guarded;
}

// A handler may run at once if the program's code was interrupted, or a system call of the C library.
bool may_handle_here(const ucontext_t& context) {
  if (!is_simulated() || waits_really.load()) return false;
  const auto at = static_cast<std::uintptr_t>(context.uc_mcontext.gregs[REG_RIP]);
  if (is_of_program(at)) return true;
  constexpr unsigned char system_call[2] = {0x0F, 0x05};
  const auto* const code = reinterpret_cast<const unsigned char*>(at);
  if (std::memcmp(code, system_call, 2) == 0) return true;  // it is restarted
  return std::memcmp(code - 2, system_call, 2) == 0 && context.uc_mcontext.gregs[REG_RAX] == -EINTR;
}

// The program may compute for a long time before its next waitpoint: a signal that could not be handled at once is
// tried again, by a timer of the system, which no child process inherits. If the timer always interrupts the C library,
// whose calls may take most of the time, the signal is handled when such a call returns.
timer_t retry{};
pid_t retry_is_of = 0;
unsigned tries = 0;
constexpr unsigned tries_max = 10;

bool is_retry(const siginfo_t& information) {
  return information.si_signo == bell && information.si_code == SI_TIMER && information.si_value.sival_ptr == &retry;
}

void try_again_soon() {
  if (!is_simulated() || waits_really.load()) return;
  if (retry_is_of != getpid()) {
    struct sigevent event {};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = bell;
    event.sigev_value.sival_ptr = &retry;
    if (WAITPOINT_NEXT(syscall)(SYS_timer_create, CLOCK_MONOTONIC, &event, &retry) != 0) return;
    retry_is_of = getpid();
    if (!has_bell) install_bell();
  }
  constexpr itimerspec in_a_millisecond{{0, 0}, {0, 1'000'000}};
  WAITPOINT_NEXT(syscall)(SYS_timer_settime, retry, 0, &in_a_millisecond, nullptr);
}

void handle_here() {
  tries = 0;
  take_in_signals_from_outside();
  if (deliverable(this_thread()) != 0) let_come();
  handle_signals();
}

void handle_what_has_come(ucontext_t& interrupted) {
  if (may_handle_here(interrupted)) return handle_here();
  if (next_kept.load() - next_taken.load() >= held_back_from) hold_back(interrupted);
  try_again_soon();
  const auto at = static_cast<std::uintptr_t>(interrupted.uc_mcontext.gregs[REG_RIP]);
  if (is_simulated() && ++tries > tries_max && c_library.contains(at) &&
      call_after_return(at, c_library, is_of_program, handle_here))
    tries = 0;
}

// The processor raised it in the running thread: it must be handled at once.
void handle_fault(int signal, siginfo_t* information, void* context) {
  // Only an instruction that may not be executed has no address; an address that cannot be executed is not looked at.
  const bool is_of_processor = signal == SIGSEGV && information->si_code == SI_KERNEL;
  if (is_of_processor && (emulate_processor_counter(context) || answer_processor_features(context))) return;
  ProgramSignals& signals = program_now().signals;
  struct sigaction& known = signals.actions[signal];
  const SignalSet blocked = is_simulated() ? this_thread().blocked : process_program.signals.blocked_before_main;
  if (!signals.is_handled(signal) || contains(blocked, signal)) return do_default_of_process(signal);
  const struct sigaction action = known;
  if ((action.sa_flags & static_cast<int>(SA_RESETHAND)) != 0) {
    known.sa_handler = SIG_DFL;
    known.sa_flags &= ~SA_SIGINFO;
    install(signal);
  }
  if (is_simulated())
    this_thread().blocked |= to_set(action.sa_mask) | ((action.sa_flags & SA_NODEFER) == 0 ? only(signal) : 0);
  if ((action.sa_flags & SA_SIGINFO) != 0)
    action.sa_sigaction(signal, information, context);
  else
    action.sa_handler(signal);
  if (is_simulated()) this_thread().blocked = blocked;
}

void interrupt_if_computing(const ucontext_t& interrupted) {
  if (!is_to_be_interrupted() || !may_handle_here(interrupted)) return;
  let_come();
  spend_tick();
}

void deal_with(siginfo_t* information, ucontext_t* context) {
  const int signal = information->si_signo;
  const int error = errno;
  if (is_question(*information)) {
    if (answer_question != nullptr) answer_question();
    errno = error;
    return;
  }
  if (is_tick(*information)) {
    interrupt_if_computing(*context);
    errno = error;
    return;
  }
  // SIGPIPE and SIGXFSZ: this thread's own write.
  const bool from_itself = (information->si_code == SI_TKILL || signal == SIGPIPE || signal == SIGXFSZ) &&
                           information->si_pid == family::system_id();
  if (has_host && !is_simulated() && (signal == SIGPIPE || signal == SIGXFSZ)) return;  // the host prefers errors
  if (contains(faults, signal) && information->si_code > 0) {
    handle_fault(signal, information, context);
  } else if (!from_itself && pass_to_watcher(*information)) {
    errno = error;
    return;
  } else if (is_simulated() && from_itself && !waits_really.load()) {
    // By the C library, which expects it to be handled at once: by abort() within it, for one.
    send(*information, this_program(), &this_thread());
    let_come();
    handle_signals();
  } else {
    if (!is_retry(*information)) keep(*information);
    if (has_come_from_outside()) handle_what_has_come(*context);
  }
  errno = error;
}

// Where the program expects the frame of this signal.
void* stack_of_program(int signal, const ucontext_t& interrupted) {
  const auto here = static_cast<std::uintptr_t>(interrupted.uc_mcontext.gregs[REG_RSP]);
  void* const below = reinterpret_cast<void*>(here - static_cast<std::uintptr_t>(red_zone_bytes));
  if (!is_simulated() || (program_now().signals.actions[signal].sa_flags & SA_ONSTACK) == 0) return below;
  const stack_t& alternate = this_thread().alternate;
  const auto low = reinterpret_cast<std::uintptr_t>(alternate.ss_sp);
  const bool is_on_it = here >= low && here - low < alternate.ss_size;
  if ((alternate.ss_flags & SS_DISABLE) != 0 || is_on_it) return below;
  return static_cast<char*>(alternate.ss_sp) + alternate.ss_size;
}

void catch_signal(int signal, siginfo_t* information, void* context) {
  if (signal == SIGSYS && (answer_library_call(*information, context) || answer_raw_call(*information, context)))
    return;
  auto* const interrupted = static_cast<ucontext_t*>(context);
  if (signal == SIGTRAP && answer_access(information, interrupted)) return;
  leave_copies(interrupted);
  if (is_on_stack_of_traps(interrupted))
    continue_on(stack_of_program(signal, *interrupted), information, interrupted, deal_with);
  deal_with(information, interrupted);
}

// A signal from outside: of several programs, the running one if it handles it, else the first one that does.
Program& program_for(int signal) {
  Program& running = program_now();
  if (!has_host || running.signals.is_handled(signal)) return running;
  for (const kernel::Task* task = first_task(); task != nullptr; task = task->next)
    if (is_thread(*task) && thread_of(*task).program->signals.is_handled(signal)) return *thread_of(*task).program;
  return running;
}

}  // namespace

bool has_come_from_outside() {
  return next_kept.load(std::memory_order_relaxed) != next_taken.load(std::memory_order_relaxed) ||
         (family::own != nullptr && family::own->letters > 0);
}

bool take_in_signals_from_outside() {
  bool any = false;
  // Signals that arrive during the loop are left for the next call: others may send them as fast as the loop runs.
  for (const unsigned end = next_kept.load(); next_taken.load() != end;) {
    Kept& place = kept[next_taken.load() % kept_max];
    if (!place.is_there.load()) break;
    const siginfo_t information = place.information;
    place.is_there.store(false);
    next_taken.fetch_add(1);
    if (is_noted_in_family(information)) continue;
    if (!ring_by_signal(information)) send(information, program_for(information.si_signo));
    any = true;
  }
  for (int i = 0; family::own != nullptr && i < family::own->letters; ++i, any = true) {
    const family::Letter& letter = family::own->inbox[i];
    Thread* const thread = letter.thread != 0 ? thread_with_id(letter.thread) : nullptr;
    if (letter.thread == 0 || (thread != nullptr && !thread->ended)) send(letter.information, process_program, thread);
  }
  if (family::own != nullptr) family::own->letters = 0;
  if (is_held_back.exchange(false)) let_come();
  return any;
}

void install(int signal) {
  WAITPOINT_CHECK(is_signal(signal), "an action is installed for a number that is no signal");
  // The host's own; and those of several programs: a signal that one of them has asked for is caught from then on.
  if (has_host && contains(ending, signal)) return;
  const ProgramSignals& signals = program_now().signals;
  const struct sigaction& action = signals.actions[signal];
  struct sigaction real {};
  real.sa_flags = SA_SIGINFO | SA_NODEFER | (action.sa_flags & (SA_RESTART | SA_ONSTACK | SA_NOCLDSTOP | SA_NOCLDWAIT));
  real.sa_sigaction = catch_signal;
  if (signal == SIGTRAP && are_accesses_trapped()) {
    if (signals.is_handled(signal)) prevent_breakpoints(AccessObstacle::trap_handler);
    real.sa_flags |= SA_ONSTACK;
  }
  if (!contains(faults, signal)) real.sa_mask = to_sigset(one_by_one);
  if (signal == bell) real.sa_flags |= SA_RESTART;  // the program did not ask for it, and must not see EINTR
  const bool is_default = !signals.is_handled(signal);
  const bool is_looked_for_always =
      has_host ||
      (signal == SIGSEGV && record != nullptr && (record->settings.trap_rdtsc || are_processor_features_trapped())) ||
      (signal == SIGSYS && (are_library_calls_trapped() || are_raw_calls_trapped())) || (signal == bell && has_bell) ||
      (signal == SIGTRAP && are_accesses_trapped()) || ends_run(signal) ||
      (on_crash != nullptr && contains(crashes, signal));
  // The system's notices of ends that are events of the family come at any time: they could end a real wait.
  const bool is_left_out = signal == SIGCHLD && family::own != nullptr && !family::has_native_child();
  const bool is_looked_for = is_looked_for_always || contains(signals.ever_blocked & ~faults, signal);
  if (is_default && action.sa_handler == SIG_IGN && !is_looked_for_always) {
    real.sa_flags &= ~SA_SIGINFO;
    real.sa_handler = SIG_IGN;
  } else if ((is_default && !is_looked_for) || is_left_out) {
    real.sa_flags &= ~SA_SIGINFO;
    real.sa_handler = SIG_DFL;
  }
  WAITPOINT_NEXT(sigaction)(signal, &real, nullptr);
  note_caught_signals();
}

void (*on_crash)(int signal) = nullptr;

bool is_question(const siginfo_t& information) {
  return information.si_signo == bell && information.si_code == SI_QUEUE && information.si_int == question &&
         record != nullptr && information.si_pid == record->file.watcher;
}

void note_caught_signals() {
  if (family::own == nullptr) return;
  const ProgramSignals& signals = program_now().signals;
  SignalSet caught = signals.ever_blocked;
  for (SignalSet left = ending; left != 0; left &= left - 1)
    if (const int signal = __builtin_ctzll(left) + 1; signals.is_handled(signal)) caught |= only(signal);
  family::own->caught = caught;
}

void install_bell() {
  has_bell = true;
  install(bell);
}

void do_default(int signal) {
  if (program_now().ends_by == nullptr) return do_default_of_process(signal);
  // Another process cannot continue a program that is one of several.
  if (!contains(stopping, signal)) program_now().ends_by(signal);
}

void do_default_of_process(int signal) {
  WAITPOINT_CHECK(is_signal(signal), "the default action is taken for a number that is no signal");
  if (contains(stopping, signal)) {
    if (family::has_others()) return family::stop(signal);
    WAITPOINT_NEXT(syscall)(SYS_kill, family::system_id(), SIGSTOP);
    return;
  }
  if (on_crash != nullptr && kernel::running != nullptr && contains(crashes, signal)) on_crash(signal);
  family::leave(signal);
  struct sigaction real {};
  real.sa_handler = SIG_DFL;
  WAITPOINT_NEXT(sigaction)(signal, &real, nullptr);
  const sigset_t set = to_sigset(only(signal));
  WAITPOINT_NEXT(pthread_sigmask)(SIG_UNBLOCK, &set, nullptr);
  WAITPOINT_NEXT(syscall)(SYS_kill, family::system_id(), signal);
}

void inherit_signals() {
  prepare_to_watch_computing();
  guarded[0] = range_of_library_with(reinterpret_cast<const void*>(&catch_signal));
  guarded[1] = range_of_library_with(reinterpret_cast<const void*>(WAITPOINT_NEXT(abort)));
  guarded[2] = range_of_library_with(reinterpret_cast<const void*>(&_dl_allocate_tls));
  for (const LibraryRange& range : guarded)
    WAITPOINT_CHECK(range.begin < range.end, "a library in which no handler may run is not found");
  ProgramSignals& signals = process_program.signals;
  for (int signal = 1; signal < signals_end; ++signal) {
    struct sigaction inherited {};
    if (WAITPOINT_NEXT(sigaction)(signal, nullptr, &inherited) != 0) continue;
    signals.actions[signal].sa_handler = inherited.sa_handler == SIG_IGN ? SIG_IGN : SIG_DFL;
  }
  sigset_t blocked;
  WAITPOINT_NEXT(pthread_sigmask)(SIG_SETMASK, nullptr, &blocked);
  signals.blocked_before_main = signals.ever_blocked = to_set(blocked);
  const SignalSet caught = record != nullptr && record->settings.reports_ending ? ending : 0;
  for (SignalSet set = to_set(blocked) | caught; set != 0; set &= set - 1) install(__builtin_ctzll(set) + 1);
  const sigset_t none = to_sigset(0);
  WAITPOINT_NEXT(pthread_sigmask)(SIG_SETMASK, &none, nullptr);
}

}  // namespace waitpoint::posix
