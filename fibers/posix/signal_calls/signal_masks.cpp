// SPDX-License-Identifier: BSD-3-Clause
//
// Each thread's mask, its alternate stack, and jumps out of handlers, which may restore an earlier mask.
#include <setjmp.h>
#include <sys/mman.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/posix/base/argument_memory.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/state_calls.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/traps/access_breakpoints.hpp"

namespace waitpoint::posix {
namespace {

SignalSet blocked_now() { return is_simulated() ? this_thread().blocked : process_program.signals.blocked_before_main; }

void block_from_now_on(SignalSet blocked) {
  if (is_simulated()) {
    set_blocked(blocked);
    if (deliverable(this_thread()) != 0) handle_signals();
    return;
  }
  ProgramSignals& signals = process_program.signals;
  signals.blocked_before_main = blocked & ~unblockable;
  signals.ever_blocked |= signals.blocked_before_main;
  for (SignalSet set = signals.blocked_before_main; set != 0; set &= set - 1) install(__builtin_ctzll(set) + 1);
}

int change_mask(int how, const sigset_t* set, sigset_t* old) {
  if (set != nullptr) before_call<"sigprocmask">(changing(place::signals));
  const SignalSet before = blocked_now();
  if (set != nullptr && !can_be_read(set)) return EFAULT;
  if (set != nullptr) {
    const SignalSet given = to_set(*set);
    switch (how) {
      case SIG_BLOCK: block_from_now_on(before | given); break;
      case SIG_UNBLOCK: block_from_now_on(before & ~given); break;
      case SIG_SETMASK: block_from_now_on(given); break;
      default: return EINVAL;
    }
  }
  if (old == nullptr) return 0;
  if (!can_be_written(old)) return EFAULT;
  *old = to_sigset(before);
  return 0;
}

// The second word of a jump buffer's mask, behind a mask of the layer's.
constexpr unsigned long mark_of_mask = 0x77706D61736B3031;  // "wpmask01"
static_assert(sizeof(__jmp_buf_tag::__saved_mask) >= 2 * sizeof(unsigned long) &&
              sizeof(SignalSet) == sizeof(unsigned long));

// Ends the calls that a jump leaves, and restores the mask.
void leave_calls(__jmp_buf_tag* buffer) {
  if (!is_simulated()) return;
  Thread& thread = this_thread();
  thread.in_wait = thread.in_cancellation_point = thread.has_temporary_mask = false;
  thread.awaited = 0;
  if (buffer->__saved_mask.__val[1] == mark_of_mask) block_from_now_on(buffer->__saved_mask.__val[0]);
}

using Jump = void (*)(__jmp_buf_tag*, int);

[[noreturn]] void jump(Jump& known, const char* name, __jmp_buf_tag* buffer, int value) {
  leave_calls(buffer);
  next(known, name)(buffer, value);
  __builtin_unreachable();
}

}  // namespace
}  // namespace waitpoint::posix

using namespace waitpoint::posix;

// Saves this thread's mask in the buffer if `is_asked`, and returns the C library's function, which then saves none.
extern "C" [[gnu::visibility("hidden"), gnu::used]] void* waitpoint_keep_mask(__jmp_buf_tag* buffer, int is_asked) {
  using Set = int (*)(__jmp_buf_tag*, int);
  static constinit Set known = nullptr;
  auto& words = buffer->__saved_mask.__val;
  if (is_asked != 0) {
    words[0] = blocked_now();
    words[1] = mark_of_mask;
  } else if (words[1] == mark_of_mask) {
    words[1] = 0;
  }
  return reinterpret_cast<void*>(next(known, "__sigsetjmp"));
}

// It returns twice, so it cannot be a function of C++.
asm(R"(
  .text
  .globl __sigsetjmp
  .type __sigsetjmp, @function
__sigsetjmp:
  .cfi_startproc
  endbr64
  pushq %rdi
  .cfi_adjust_cfa_offset 8
  subq $16, %rsp
  .cfi_adjust_cfa_offset 16
  call waitpoint_keep_mask
  addq $16, %rsp
  .cfi_adjust_cfa_offset -16
  popq %rdi
  .cfi_adjust_cfa_offset -8
  xorl %esi, %esi
  jmpq *%rax
  .cfi_endproc
  .size __sigsetjmp, .-__sigsetjmp
)");

extern "C" {
[[gnu::visibility("default")]] void waitpoint_siglongjmp(__jmp_buf_tag*, int) __asm__("siglongjmp");
[[gnu::visibility("default")]] void waitpoint_longjmp(__jmp_buf_tag*, int) __asm__("longjmp");
[[gnu::visibility("default")]] void waitpoint_plain_longjmp(__jmp_buf_tag*, int) __asm__("_longjmp");
[[gnu::visibility("default")]] void waitpoint_checked_longjmp(__jmp_buf_tag*, int) __asm__("__longjmp_chk");
}
void waitpoint_siglongjmp(__jmp_buf_tag* buffer, int value) {
  static constinit Jump known = nullptr;
  jump(known, "siglongjmp", buffer, value);
}
void waitpoint_longjmp(__jmp_buf_tag* buffer, int value) {
  static constinit Jump known = nullptr;
  jump(known, "longjmp", buffer, value);
}
void waitpoint_plain_longjmp(__jmp_buf_tag* buffer, int value) {
  static constinit Jump known = nullptr;
  jump(known, "_longjmp", buffer, value);
}
// The C library would check that the jump goes up the stack, which fails from an alternate stack to a thread's.
void waitpoint_checked_longjmp(__jmp_buf_tag* buffer, int value) {
  static constinit Jump known = nullptr;
  jump(known, "siglongjmp", buffer, value);
}

WAITPOINT_INTERPOSED int pthread_sigmask(int how, const sigset_t* set, sigset_t* old) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(pthread_sigmask)(how, set, old);
  return change_mask(how, set, old);
}
WAITPOINT_INTERPOSED int sigprocmask(int how, const sigset_t* set, sigset_t* old) noexcept {
  if (is_host_code()) return WAITPOINT_NEXT(sigprocmask)(how, set, old);
  const int error = change_mask(how, set, old);
  return error == 0 ? 0 : fail(error);
}

WAITPOINT_INTERPOSED int sigpending(sigset_t* set) noexcept {
  before_call<"sigpending">(reading(place::signals | place::timers));
  if (!is_simulated()) return WAITPOINT_NEXT(sigpending)(set);
  if (!can_be_written(set)) return fail(EFAULT);
  take_in_signals_from_outside();
  const Thread& thread = this_thread();
  *set = to_sigset(pending_for(thread) & thread.blocked);
  return 0;
}

WAITPOINT_INTERPOSED int sighold(int signal) noexcept {
  if (!is_signal(signal)) return fail(EINVAL);
  block_from_now_on(blocked_now() | only(signal));
  return 0;
}
WAITPOINT_INTERPOSED int sigrelse(int signal) noexcept {
  if (!is_signal(signal)) return fail(EINVAL);
  block_from_now_on(blocked_now() & ~only(signal));
  return 0;
}
// SIG_HOLD is an action too.
WAITPOINT_INTERPOSED __sighandler_t sigset(int signal, __sighandler_t handler) noexcept {
  struct sigaction action {
  }, old{};
  if (!is_signal(signal) || handler == SIG_ERR) {
    errno = EINVAL;
    return SIG_ERR;
  }
  const bool was_held = contains(blocked_now(), signal);
  if (handler == SIG_HOLD) {
    if (sigaction(signal, nullptr, &old) != 0) return SIG_ERR;
    block_from_now_on(blocked_now() | only(signal));
  } else {
    action.sa_handler = handler;
    if (sigaction(signal, &action, &old) != 0) return SIG_ERR;
    block_from_now_on(blocked_now() & ~only(signal));
  }
  return was_held ? SIG_HOLD : old.sa_handler;
}
WAITPOINT_INTERPOSED int sigblock(int mask) noexcept {
  const SignalSet before = blocked_now();
  block_from_now_on(before | static_cast<unsigned>(mask));
  return static_cast<int>(before);
}
WAITPOINT_INTERPOSED int sigsetmask(int mask) noexcept {
  const SignalSet before = blocked_now();
  block_from_now_on(static_cast<unsigned>(mask));
  return static_cast<int>(before);
}
WAITPOINT_INTERPOSED int siggetmask() noexcept { return static_cast<int>(blocked_now()); }

// The system needs it too, for signals of the processor: these use the stack that was set last.
WAITPOINT_INTERPOSED int sigaltstack(const stack_t* stack, stack_t* old) noexcept {
  if (!is_simulated()) return WAITPOINT_NEXT(sigaltstack)(stack, old);
  if ((stack != nullptr && !can_be_read(stack)) || (old != nullptr && !can_be_written(old))) return fail(EFAULT);
  Thread& thread = this_thread();
  stack_t before = thread.alternate;
  WAITPOINT_CHECK((before.ss_flags & ~SS_DISABLE) == 0, "an alternate stack is kept with flags that only calls have");
  const auto* const here = reinterpret_cast<const char*>(&before);
  const auto* const low = static_cast<const char*>(before.ss_sp);
  const bool is_on_it = (before.ss_flags & SS_DISABLE) == 0 && here >= low && here < low + before.ss_size;
  if (is_on_it) before.ss_flags |= SS_ONSTACK;
  if (stack != nullptr) {
    if (is_on_it) return fail(EPERM);
    constexpr int autodisarm = static_cast<int>(1U << 31);
    const int flags = stack->ss_flags & ~autodisarm;
    if (flags != 0 && flags != SS_DISABLE && flags != SS_ONSTACK) return fail(EINVAL);
    if (flags != SS_DISABLE && stack->ss_size < 2048) return fail(ENOMEM);
    if (WAITPOINT_NEXT(sigaltstack)(stack, nullptr) != 0 && errno != EPERM) return -1;
    keep_stack_of_traps();
    thread.alternate = *stack;
    thread.alternate.ss_flags = flags == SS_DISABLE ? SS_DISABLE : 0;
    if (flags == SS_DISABLE) thread.alternate = {nullptr, SS_DISABLE, 0};
  }
  if (old != nullptr) *old = before;
  return 0;
}
