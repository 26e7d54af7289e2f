// SPDX-License-Identifier: BSD-3-Clause
#include "fibers/posix/traps/access_breakpoints.hpp"

#include <dlfcn.h>
#include <link.h>
#include <sys/mman.h>
#include <sys/syscall.h>
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
#include "fibers/posix/traps/library_range.hpp"
#include "fibers/posix/traps/memory_peek.hpp"
#include "fibers/posix/traps/report_stacks.hpp"
#include "fibers/posix/traps/signal_frame.hpp"
#include "fibers/posix/traps/spinning.hpp"
#include "fibers/posix/traps/watched_code.hpp"

namespace waitpoint::posix {
namespace {

constexpr std::uint8_t breakpoint = 0xCC;  // int3
constexpr std::uint64_t page_bytes = 4096;

struct Breakpoint {
  bool is_set;
  std::uint32_t hits;
};

// Of the threads by their ids; two that share one are told apart.
constexpr std::size_t spinning_kept = 1024;
struct Tables {
  Spinning spinning[spinning_kept];
  Breakpoint placed[];  // for each of the instructions
};

Breakpoints asked{};
WatchedCode code;
Tables* tables = nullptr;
std::size_t table_bytes = 0;
ReportStacks stacks;
std::uint32_t hits = 0, spins = 0;
bool is_trapped = false, is_prevented = false;
unsigned long long loaded_before = 0;

// Its own, not a jump to another's, by which it may know the address, too.
bool defines_allocator() {
  const void* const allocator = dlsym(RTLD_DEFAULT, "malloc");
  Dl_info of_allocator{};
  const ElfW(Sym)* symbol = nullptr;
  return code.contains(allocator) &&
         dladdr1(allocator, &of_allocator, const_cast<void**>(reinterpret_cast<const void**>(&symbol)),
                 RTLD_DL_SYMENT) != 0 &&
         symbol != nullptr && symbol->st_shndx != SHN_UNDEF;
}

// Of modules that were not loaded before.
AccessObstacle obstacle_in_code() {
  switch (code.find_loaded()) {
    case WatchedCode::Found::good: return defines_allocator() ? AccessObstacle::allocator : AccessObstacle::none;
    case WatchedCode::Found::changed: return AccessObstacle::changed_code;
    case WatchedCode::Found::no_memory: return AccessObstacle::no_memory;
  }
  return AccessObstacle::none;
}

void set_access_to_code_at(std::uint64_t page, int access) {
  WAITPOINT_CHECK(call_directly(SYS_mprotect, static_cast<long>(page), page_bytes, access) == 0,
                  "the protection of the program's code cannot be changed");
}

// Changes the first bytes of those of these instructions that are to be `set`, or not; page by page.
void place_breakpoints(std::size_t from, std::size_t to, bool set) {
  std::uint64_t writable = 0;
  for (std::size_t i = from; i < to; ++i) {
    if (tables->placed[i].is_set == set || !code.is_loaded(i)) continue;
    const std::uint64_t page = code.address_of(i) & ~(page_bytes - 1);
    if (page != writable && writable != 0) set_access_to_code_at(writable, PROT_READ | PROT_EXEC);
    if (page != writable) set_access_to_code_at(page, PROT_READ | PROT_WRITE | PROT_EXEC);
    writable = page;
    tables->placed[i].is_set = set;
    *code.at(i) = set ? breakpoint : code[i].code[0];
  }
  if (writable != 0) set_access_to_code_at(writable, PROT_READ | PROT_EXEC);
}

void remove_breakpoints(std::size_t from, std::size_t to) { place_breakpoints(from, to, false); }

// The memory that is kept for all runs, if it is large enough: the stacks, and behind them the tables.
char* kept_memory = nullptr;
std::size_t kept_bytes = 0;
bool are_tables_kept() { return kept_memory != nullptr && ReportStacks::bytes + table_bytes <= kept_bytes; }

bool make_tables() {
  table_bytes = sizeof(Tables) + code.size() * sizeof(Breakpoint);
  if (are_tables_kept()) {
    tables = reinterpret_cast<Tables*>(kept_memory + ReportStacks::bytes);
    return true;
  }
  const long memory = call_directly(SYS_mmap, 0, static_cast<long>(table_bytes), PROT_READ | PROT_WRITE,
                                    MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory < 0 && memory > -4096) return false;
  tables = reinterpret_cast<Tables*>(memory);
  return true;
}

bool begin_traps() {
  if (program_now().signals.is_handled(SIGTRAP)) {
    asked.prevented(AccessObstacle::trap_handler);
    return false;
  }
  if (!make_tables() || !stacks.make(kept_memory)) {
    asked.prevented(AccessObstacle::no_memory);
    return false;
  }
  is_trapped = true;
  install(SIGTRAP);
  return true;
}

// Libraries may be loaded later, before a further thread is made.
void set_breakpoints() {
  if (is_prevented || (!is_trapped && !begin_traps())) {
    is_prevented = true;
    before_thread = nullptr;
    return;
  }
  const unsigned long long loaded = libraries_loaded();
  if (loaded == loaded_before) return;
  loaded_before = loaded;
  if (const AccessObstacle obstacle = obstacle_in_code(); obstacle != AccessObstacle::none) {
    before_thread = nullptr;
    return prevent_breakpoints(obstacle);
  }
  place_breakpoints(0, code.size(), true);
  asked.loaded(code.loaded());
  if (code.are_all_loaded()) before_thread = nullptr;
}

std::uint64_t operand_of(std::size_t i, const greg_t* registers) {
  const AccessInstruction& instruction = code[i];
  auto address = static_cast<std::uint64_t>(instruction.displacement);
  if (instruction.base != AccessInstruction::none) address += static_cast<std::uint64_t>(registers[instruction.base]);
  if (instruction.index != AccessInstruction::none)
    address += static_cast<std::uint64_t>(registers[instruction.index]) * instruction.scale;
  if (instruction.bit != AccessInstruction::none) {
    // The number of the bit has the size of the word, and a sign.
    const int unused = 64 - 8 * instruction.bytes;
    const std::int64_t bit = static_cast<std::int64_t>(registers[instruction.bit]) << unused >> unused;
    const std::int64_t word = bit >> (instruction.bytes == 8 ? 6 : instruction.bytes == 4 ? 5 : 4);
    address += static_cast<std::uint64_t>(word * instruction.bytes);
  }
  return instruction.is_absolute ? address + code.loaded_at(i) : address;
}

Spinning& spinning_of(const Thread& thread) {
  return tables->spinning[static_cast<std::size_t>(thread.id) % spinning_kept];
}

// False if the breakpoint is removed.
bool count_hit(std::size_t i) {
  const bool is_last = ++hits >= asked.hits_max || spins >= asked.spins_max;
  const bool is_last_of_one = ++tables->placed[i].hits >= asked.hits_of_one_max;
  if (!is_last && !is_last_of_one) return true;
  asked.missed();
  remove_breakpoints(is_last ? 0 : i, is_last ? code.size() : i + 1);
  return false;
}

// An instruction that reads, changes and writes without a lock is two accesses: what others write between them is lost,
// as on several processors.
void report_both(const AccessInstruction& instruction, std::uint64_t address) {
  std::uint8_t before[64], now[64];
  asked.report(address, instruction.bytes, false, false, instruction.place);
  const bool is_readable = peek(address, before, instruction.bytes);
  const std::uint64_t switches = asked.switches();
  asked.report(address, instruction.bytes, true, false, instruction.place);
  if (asked.switches() == switches) return;
  if (is_readable && peek(address, now, instruction.bytes) && std::memcmp(now, before, instruction.bytes) != 0)
    (void)poke(address, before, instruction.bytes);
}

// Of a string instruction, up to this many bytes, which go up.
constexpr std::uint64_t string_max = 4096;
std::uint64_t bytes_of(const AccessInstruction& instruction, const greg_t* registers) {
  if (!instruction.is_repeated) return instruction.bytes;
  constexpr greg_t goes_down = 0x400;  // of EFLAGS
  if ((registers[REG_EFL] & goes_down) != 0) return 0;
  return std::min(static_cast<std::uint64_t>(registers[REG_RCX]), string_max / instruction.bytes) * instruction.bytes;
}

void report(std::size_t i, const greg_t* registers) {
  const AccessInstruction& instruction = code[i];
  const std::uint64_t address = operand_of(i, registers), bytes = bytes_of(instruction, registers);
  const auto source = static_cast<std::uint64_t>(registers[REG_RSI]);
  if (code.has_within(address, bytes) || (instruction.copies && code.has_within(source, bytes)))
    return prevent_breakpoints(AccessObstacle::own_code);
  Thread& thread = this_thread();
  const bool spins_here =
      instruction.reads && !instruction.is_repeated &&
      spinning_of(thread).reads(thread.id, thread.task->sequence, instruction.place, address, bytes);
  if (spins_here) {
    ++spins;
    --hits;
    --tables->placed[i].hits;
    asked.let_others_run();
  } else if (bytes != 0) {
    if (instruction.copies) asked.report(source, static_cast<std::uint32_t>(bytes), false, false, instruction.place);
    if (instruction.reads && instruction.writes && !instruction.is_locked)
      report_both(instruction, address);
    else
      asked.report(address, static_cast<std::uint32_t>(bytes), instruction.writes, instruction.is_locked,
                   instruction.place);
  }
  if (!is_prevented) spinning_of(thread).passed(thread.task->sequence);
}

// The number of the instruction before which the context is.
std::size_t instruction_of(const ucontext_t* context) {
  return code.number_at(static_cast<std::uint64_t>(context->uc_mcontext.gregs[REG_RIP]));
}

void go_on_in_copy(ucontext_t* context) {
  if (is_prevented) return;
  context->uc_mcontext.gregs[REG_RIP] = static_cast<greg_t>(code.copy_of(instruction_of(context)));
}

// Stacks are unwound from here if the thread is cancelled: the context is that of the program's own code until then.
void handle_and_return(siginfo_t*, ucontext_t* context) {
  {
    const ErrorNumberKept kept;
    handle_signals();
  }
  go_on_in_copy(context);
}

// On a report's stack. A handler of a signal that came with the report is run on the program's own afterwards, so that
// it is neither between the two accesses of an instruction nor on a stack that is not its thread's.
void report_and_return(siginfo_t* information, ucontext_t* context) {
  greg_t* const registers = context->uc_mcontext.gregs;
  Thread& thread = this_thread();
  {
    const ErrorNumberKept kept;
    const bool in_wait = thread.in_wait;
    thread.in_wait = true;
    report(instruction_of(context), registers);
    thread.in_wait = in_wait;
  }
  stacks.give_back(context);
  if (!thread.delivery_due) return go_on_in_copy(context);
  continue_on(reinterpret_cast<void*>(registers[REG_RSP] - red_zone_bytes), information, context, handle_and_return);
}

}  // namespace

void keep_memory_for_breakpoints(void* memory, std::size_t bytes) {
  WAITPOINT_CHECK(bytes >= ReportStacks::bytes, "the memory kept for breakpoints is too small for their stacks");
  kept_memory = static_cast<char*>(memory);
  kept_bytes = bytes;
}

void trap_accesses(const Breakpoints& breakpoints) {
  if (breakpoints.instructions.empty()) return;
  asked = breakpoints;
  code.watch(asked.instructions, asked.libraries);
  loaded_before = 0;
  before_thread = set_breakpoints;
}

bool are_accesses_trapped() { return is_trapped; }

void prevent_breakpoints(AccessObstacle obstacle) {
  if (!is_trapped || is_prevented) return;
  is_prevented = true;
  asked.prevented(obstacle);
  remove_breakpoints(0, code.size());
}

void prevent_breakpoints_in(const void* begin, std::size_t bytes) {
  if (is_trapped && code.has_within(reinterpret_cast<std::uint64_t>(begin), bytes))
    prevent_breakpoints(AccessObstacle::changed_code);
}

void restore_code() {
  if (!is_trapped) return;
  if (!is_prevented) remove_breakpoints(0, code.size());
  code.leave();
  stacks.remove();
  if (!are_tables_kept()) call_directly(SYS_munmap, reinterpret_cast<long>(tables), static_cast<long>(table_bytes));
  is_trapped = false;
}

bool answer_access(siginfo_t* information, ucontext_t* context) {
  if (!is_trapped || information->si_code <= 0) return false;
  greg_t* const registers = context->uc_mcontext.gregs;
  const std::uint64_t at = static_cast<std::uint64_t>(registers[REG_RIP]) - 1;
  const std::size_t i = code.number_at(at);
  if (i == code.size()) return false;
  if (*code.at(i) == breakpoint && !tables->placed[i].is_set) return false;  // the program's own
  registers[REG_RIP] = static_cast<greg_t>(tables->placed[i].is_set ? code.copy_of(i) : at);
  if (!is_simulated() || !tables->placed[i].is_set || !count_hit(i)) return true;
  void* const stack = stacks.take();
  if (stack == nullptr) return true;
  registers[REG_RIP] = static_cast<greg_t>(at);
  continue_on(stack, information, context, report_and_return);
}

void leave_copies(ucontext_t* context) {
  greg_t& place = context->uc_mcontext.gregs[REG_RIP];
  if (is_trapped) place = static_cast<greg_t>(code.original_of(static_cast<std::uint64_t>(place)));
}

bool is_on_stack_of_traps(const ucontext_t* context) { return is_trapped && stacks.is_of_system(context); }

void keep_stack_of_traps() {
  if (is_trapped) stacks.keep_for_system();
}

}  // namespace waitpoint::posix
