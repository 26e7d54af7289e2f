// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/access_breakpoints.hpp"

#include <link.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"
#include "fibers/posix/base/direct_call.hpp"
#include "fibers/posix/base/error_number.hpp"
#include "fibers/posix/program/program.hpp"
#include "fibers/posix/program/thread.hpp"
#include "fibers/posix/signals/signals.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::uint8_t breakpoint = 0xCC;  // int3
constexpr greg_t trap_flag = 0x100;        // of EFLAGS
constexpr std::uint64_t page_bytes = 4096;

struct Breakpoint {
  std::uint8_t original;
  bool is_set;
  std::uint32_t hits;
};

Breakpoints asked{};
Breakpoint* placed = nullptr;  // for each of the instructions
std::uint64_t loaded_at = 0;
std::uint32_t hits = 0;
std::uint64_t stepped = 0;  // the address of the instruction in its single step; 0: none
bool is_trapped = false;

std::uint8_t* code_at(const AccessInstruction& instruction) {
  return reinterpret_cast<std::uint8_t*>(loaded_at + instruction.offset);
}

int note_load_address(dl_phdr_info* program, std::size_t, void*) {
  loaded_at = program->dlpi_addr;
  return 1;  // the program is the first
}

void set_breakpoint(std::size_t i) {
  std::uint8_t* const code = code_at(asked.instructions[i]);
  placed[i] = {*code, true, placed[i].hits};
  *code = breakpoint;
}

void remove_breakpoint(std::size_t i) {
  if (!placed[i].is_set) return;
  *code_at(asked.instructions[i]) = placed[i].original;
  placed[i].is_set = false;
}

// Of the pages with breakpoints, one by one.
bool set_access_to_code(int access) {
  std::uint64_t done_to = 0;
  for (const AccessInstruction& instruction : asked.instructions) {
    const std::uint64_t page = reinterpret_cast<std::uint64_t>(code_at(instruction)) & ~(page_bytes - 1);
    if (page < done_to) continue;
    done_to = page + page_bytes;
    if (call_directly(SYS_mprotect, static_cast<long>(page), page_bytes, access) != 0) return false;
  }
  return true;
}

std::size_t bytes_of_placed() { return asked.instructions.size() * sizeof(Breakpoint); }

void set_all() {
  before_first_thread = nullptr;
  dl_iterate_phdr(note_load_address, nullptr);
  const long memory = call_directly(SYS_mmap, 0, static_cast<long>(bytes_of_placed()), PROT_READ | PROT_WRITE,
                                    MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory < 0 && memory > -4096) refuse("there is no memory for breakpoints at accesses");
  placed = reinterpret_cast<Breakpoint*>(memory);
  if (!set_access_to_code(PROT_READ | PROT_WRITE | PROT_EXEC))
    refuse("the program's code cannot be made writable for breakpoints at accesses");
  is_trapped = true;
  install(SIGTRAP);
  for (std::size_t i = 0; i < asked.instructions.size(); ++i) set_breakpoint(i);
}

// The number of the instruction at this address; that of all if there is none.
std::size_t instruction_at(std::uint64_t address) {
  const auto all = asked.instructions;
  const auto found = std::lower_bound(
      all.begin(), all.end(), address - loaded_at,
      [](const AccessInstruction& instruction, std::uint64_t offset) { return instruction.offset < offset; });
  return found != all.end() && found->offset == address - loaded_at ? static_cast<std::size_t>(found - all.begin())
                                                                    : all.size();
}

std::uint64_t address_of(const AccessInstruction& instruction, const greg_t* registers) {
  auto address = static_cast<std::uint64_t>(instruction.displacement);
  if (instruction.base != AccessInstruction::none) address += static_cast<std::uint64_t>(registers[instruction.base]);
  if (instruction.index != AccessInstruction::none)
    address += static_cast<std::uint64_t>(registers[instruction.index]) * instruction.scale;
  return instruction.is_absolute ? address + loaded_at : address;
}

void count_hit(std::size_t i) {
  constexpr std::uint32_t looks_like_a_loop = 1000;
  const bool is_last = ++hits >= asked.hits_max, is_last_of_one = ++placed[i].hits >= asked.hits_of_one_max;
  if (is_last || is_last_of_one) asked.missed();
  if (is_last_of_one) remove_breakpoint(i);
  for (std::size_t each = 0; is_last && each < asked.instructions.size(); ++each) remove_breakpoint(each);
  if (placed[i].hits % looks_like_a_loop == 0 && is_simulated()) asked.let_others_run();
}

// Other threads may run before it. An instruction that reads, changes and writes without a lock is two accesses: what
// others write between them is lost, as on several processors.
void report(const AccessInstruction& instruction, std::uint64_t address) {
  const bool is_split = instruction.reads && instruction.writes && !instruction.is_locked;
  void* const memory = reinterpret_cast<void*>(address);
  std::uint8_t before[64];
  if (is_split) {
    asked.report(address, instruction.bytes, false, false, instruction.offset);
    std::memcpy(before, memory, instruction.bytes);
  }
  asked.report(address, instruction.bytes, instruction.writes, instruction.is_locked, instruction.offset);
  if (is_split && std::memcmp(memory, before, instruction.bytes) != 0) std::memcpy(memory, before, instruction.bytes);
}

// The instruction has been executed.
bool end_step(greg_t* registers) {
  if (stepped == 0) return false;
  registers[REG_EFL] &= ~trap_flag;
  const std::size_t i = instruction_at(stepped);
  if (placed[i].is_set) *code_at(asked.instructions[i]) = breakpoint;
  stepped = 0;
  return true;
}

}  // namespace

void trap_accesses(const Breakpoints& breakpoints) {
  if (breakpoints.instructions.empty()) return;
  asked = breakpoints;
  before_first_thread = set_all;
}

bool are_accesses_trapped() { return is_trapped; }

void restore_code() {
  if (!is_trapped) return;
  for (std::size_t i = 0; i < asked.instructions.size(); ++i) remove_breakpoint(i);
  WAITPOINT_CHECK(set_access_to_code(PROT_READ | PROT_EXEC), "the code's protection cannot be restored");
  call_directly(SYS_munmap, reinterpret_cast<long>(placed), static_cast<long>(bytes_of_placed()));
  is_trapped = false;
}

bool answer_access(void* context) {
  if (!is_trapped) return false;
  greg_t* const registers = static_cast<ucontext_t*>(context)->uc_mcontext.gregs;
  if (end_step(registers)) return true;
  const std::uint64_t at = static_cast<std::uint64_t>(registers[REG_RIP]) - 1;
  const std::size_t i = instruction_at(at);
  if (i == asked.instructions.size()) return false;
  const ErrorNumberKept kept;
  registers[REG_RIP] = static_cast<greg_t>(at);
  const AccessInstruction& instruction = asked.instructions[i];
  if (placed[i].is_set) count_hit(i);
  if (is_simulated()) report(instruction, address_of(instruction, registers));
  if (!placed[i].is_set) return true;  // removed, maybe meanwhile
  *code_at(instruction) = placed[i].original;
  registers[REG_EFL] |= trap_flag;
  stepped = at;
  return true;
}

}  // namespace waitpoint::posix
