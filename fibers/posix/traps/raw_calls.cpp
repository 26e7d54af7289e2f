// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/raw_calls.hpp"

#include <dlfcn.h>
#include <linux/audit.h>
#include <linux/prctl.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <ucontext.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/system_call_words.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/traps/followed_calls.hpp"
#include "fibers/posix/traps/library_range.hpp"

extern "C" void* _dl_allocate_tls(void*);  // of the dynamic linker

namespace waitpoint::posix {
namespace {

constexpr int code_of_dispatch = 2;  // SYS_USER_DISPATCH

static_assert(sizeof raw_calls == 1 && static_cast<int>(RawCalls::pass) == SYSCALL_DISPATCH_FILTER_ALLOW &&
                  static_cast<int>(RawCalls::are_trapped) == SYSCALL_DISPATCH_FILTER_BLOCK,
              "the system reads it");

bool is_dispatched = false, follows = false;

// Of the instructions that are exempt; and of those that are trapped, but not the program's.
LibraryRange exempt, layer, linker;

bool has_sanitizer() {
  for (const char* const name : {"__asan_init", "__msan_init", "__lsan_do_leak_check", "__hwasan_init"})
    if (dlsym(RTLD_DEFAULT, name) != nullptr) return true;
  return false;
}

// True if the system traps the calls by all other instructions from now on.
bool dispatch_outside(LibraryRange range) {
  return call_directly(SYS_prctl, PR_SET_SYSCALL_USER_DISPATCH, static_cast<long>(PR_SYS_DISPATCH_ON),
                       static_cast<long>(range.begin), static_cast<long>(range.end - range.begin),
                       reinterpret_cast<long>(&raw_calls)) == 0;
}

long call_system(long number, const CallWords& words) {
  return call_directly(number, words.at[0], words.at[1], words.at[2], words.at[3], words.at[4], words.at[5]);
}

}  // namespace

void trap_raw_calls() {
  if (has_sanitizer()) {
    if (record->settings.strict)
      refuse("--strict: the program has a sanitizer's runtime, whose calls are not simulated");
    return;
  }
  is_dispatched = true;
  layer = range_of_library_with(reinterpret_cast<const void*>(&trap_raw_calls));
  linker = range_of_library_with(reinterpret_cast<const void*>(&_dl_allocate_tls));
  exempt = range_of_library_with(reinterpret_cast<const void*>(WAITPOINT_NEXT(abort)));
  WAITPOINT_CHECK(exempt.begin < exempt.end, "the C library is not found");
  install(SIGSYS);
  trap_raw_calls_of_child();
}

void trap_raw_calls_of_child() {
  if (!is_dispatched) return;
  follows = false;
  raw_calls = RawCalls::are_trapped;
  if (dispatch_outside(exempt)) return;
  if (record->settings.strict)
    refuse("--strict: the system does not let raw system calls be trapped (Linux 5.11 does)");
  is_dispatched = false;
  raw_calls = RawCalls::pass;
  install(SIGSYS);
}

bool are_raw_calls_trapped() { return is_dispatched; }

void follow_all_calls(bool (*can_map_again)(LibraryRange range)) {
  if (!is_dispatched) return;
  begin_to_follow_calls(can_map_again);
  follows = dispatch_outside(return_from_handlers());
}

bool follow_calls_for_snapshots() {
  if (!is_dispatched) return false;
  begin_to_follow_calls_for_snapshots();
  return follows = dispatch_outside(return_from_handlers());
}

bool are_calls_undoable() { return follows; }

namespace {

// Of the system; or, if it is followed and cannot be undone, by the instruction itself, once it is no longer trapped:
// it may be a call that must not be made in a handler, such as vfork().
void call_or_repeat(long number, const CallWords& words, ucontext_t& context, bool is_exempt) {
  greg_t* const registers = context.uc_mcontext.gregs;
  constexpr greg_t size_of_instruction = 2;
  if (follows) {
    if (follow_call(number, words, context)) return;
    follows = false;
    WAITPOINT_CHECK(dispatch_outside(exempt), "the system no longer traps raw calls");
  }
  if (is_exempt) {
    registers[REG_RIP] -= size_of_instruction;
    registers[REG_RAX] = number;
    return;
  }
  registers[REG_RAX] = call_system(number, words);
}

}  // namespace

bool answer_raw_call(const siginfo_t& information, void* context) {
  if (information.si_code != code_of_dispatch) return false;
  const ErrorNumberKept kept;
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  const CallWords words{{registers[REG_RDI], registers[REG_RSI], registers[REG_RDX], registers[REG_R10],
                         registers[REG_R8], registers[REG_R9]}};
  const auto at = reinterpret_cast<std::uintptr_t>(information.si_call_addr);
  const long number = information.si_syscall;
  if (information.si_arch != AUDIT_ARCH_X86_64) {
    registers[REG_RAX] = -ENOSYS;
  } else if (!is_simulated() || layer.contains(at) || linker.contains(at) || exempt.contains(at)) {
    call_or_repeat(number, words, *static_cast<ucontext_t*>(context), exempt.contains(at));
  } else {
    const long result = simulated_call(number, words);
    registers[REG_RAX] = result == -1 ? -errno : result;
  }
  return true;
}

}  // namespace waitpoint::posix
