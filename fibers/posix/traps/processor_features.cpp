// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/processor_features.hpp"

#include <asm/prctl.h>
#include <cpuid.h>
#include <fcntl.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

bool are_features_trapped = false;

bool let_instruction_fault(bool faults) { return call_directly(SYS_arch_prctl, ARCH_SET_CPUID, faults ? 0 : 1) == 0; }

bool is_in_debugger() {
  char text[2048];
  const long file = call_directly(SYS_openat, AT_FDCWD, reinterpret_cast<long>("/proc/self/status"), O_RDONLY);
  if (file < 0) return false;
  const long size = call_directly(SYS_read, file, reinterpret_cast<long>(text), sizeof text - 1);
  call_directly(SYS_close, file);
  text[size > 0 ? size : 0] = '\0';
  constexpr char line[] = "\nTracerPid:\t";
  const char* const found = std::strstr(text, line);
  return found != nullptr && std::atoi(found + std::strlen(line)) != 0;
}

/// The registers that the instruction writes.
struct Features {
  std::uint32_t a = 0, b = 0, c = 0, d = 0;
};

constexpr std::uint32_t bit(int number) { return std::uint32_t{1} << number; }

// Numbers of the leaves, and their contents, are those of Intel's and AMD's manuals.
void hide_what_differs(std::uint32_t leaf, std::uint32_t sub, Features& features) {
  switch (leaf) {
    case 0x1:
      features.b &= 0x00FF'FFFF;  // the number of the core (APIC id)
      features.c &= ~bit(30);     // rdrand
      break;
    case 0x7:
      if (sub != 0) break;
      features.b &= ~bit(18);  // rdseed
      features.c &= ~bit(22);  // rdpid
      break;
    case 0xB:
    case 0x1F: features.d = 0; break;  // the number of the core
    case 0x8000'001E:
      features.a = 0;
      features.b &= ~0xFFU;
      features.c &= ~0xFFU;
      break;
    default: break;
  }
}

}  // namespace

void trap_processor_features() {
  if (is_in_debugger() || !let_instruction_fault(true)) return;
  are_features_trapped = true;
  install(SIGSEGV);
}

bool are_processor_features_trapped() { return are_features_trapped; }

bool answer_processor_features(void* context) {
  if (!are_features_trapped) return false;
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  constexpr unsigned char instruction[2] = {0x0F, 0xA2};
  if (std::memcmp(reinterpret_cast<const void*>(registers[REG_RIP]), instruction, sizeof instruction) != 0)
    return false;
  const auto leaf = static_cast<std::uint32_t>(registers[REG_RAX]),
             sub = static_cast<std::uint32_t>(registers[REG_RCX]);
  Features features;
  let_instruction_fault(false);
  __cpuid_count(leaf, sub, features.a, features.b, features.c, features.d);
  let_instruction_fault(true);
  hide_what_differs(leaf, sub, features);
  registers[REG_RAX] = features.a;
  registers[REG_RBX] = features.b;
  registers[REG_RCX] = features.c;
  registers[REG_RDX] = features.d;
  registers[REG_RIP] += static_cast<greg_t>(sizeof instruction);
  return true;
}

}  // namespace waitpoint::posix
