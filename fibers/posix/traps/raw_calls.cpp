// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/raw_calls.hpp"

#include <dlfcn.h>
#include <linux/audit.h>
#include <linux/prctl.h>
#include <sys/prctl.h>
#include <ucontext.h>

#include <cerrno>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/base/interposed.hpp"
#include "fibers/posix/base/system_call_words.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/signals/signals.hpp"
#include "fibers/posix/traps/library_range.hpp"

extern "C" void* _dl_allocate_tls(void*);  // of the dynamic linker

namespace waitpoint::posix {
namespace {

constexpr int code_of_dispatch = 2;  // SYS_USER_DISPATCH

static_assert(sizeof raw_calls == 1 && static_cast<int>(RawCalls::pass) == SYSCALL_DISPATCH_FILTER_ALLOW &&
                  static_cast<int>(RawCalls::are_trapped) == SYSCALL_DISPATCH_FILTER_BLOCK,
              "the system reads it");

bool is_dispatched = false;

// Of the instructions that are exempt; and of those that are trapped, but not the program's.
LibraryRange exempt, layer, linker;

bool has_sanitizer() {
  for (const char* const name : {"__asan_init", "__msan_init", "__lsan_do_leak_check", "__hwasan_init"})
    if (dlsym(RTLD_DEFAULT, name) != nullptr) return true;
  return false;
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
  const ErrorNumberKept kept;
  raw_calls = RawCalls::are_trapped;
  if (WAITPOINT_NEXT(prctl)(PR_SET_SYSCALL_USER_DISPATCH, static_cast<long>(PR_SYS_DISPATCH_ON), exempt.begin,
                            exempt.end - exempt.begin, &raw_calls) == 0)
    return;
  if (record->settings.strict)
    refuse("--strict: the system does not let raw system calls be trapped (Linux 5.11 does)");
  is_dispatched = false;
  raw_calls = RawCalls::pass;
  install(SIGSYS);
}

bool are_raw_calls_trapped() { return is_dispatched; }

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
  } else if (!is_simulated() || layer.contains(at) || linker.contains(at)) {
    registers[REG_RAX] = call_system(number, words);
  } else {
    const long result = simulated_call(number, words);
    registers[REG_RAX] = result == -1 ? -errno : result;
  }
  return true;
}

}  // namespace waitpoint::posix
